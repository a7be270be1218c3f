//! Generates the gRPC code from `proto/`, without a protoc on the machine, and lists the models to embed.

use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

use prost::Message;

fn main() -> Result<(), Box<dyn Error>> {
    const FILES: [&str; 5] = ["common", "network", "request", "departure", "tour"];
    println!("cargo:rerun-if-changed=proto");
    println!("cargo:rerun-if-changed=migrations");
    println!("cargo:rerun-if-changed=models");
    let files = FILES.map(|name| format!("voltour/v1/{name}.proto"));
    let descriptors = protox::compile(files, ["proto"])?;
    let out = PathBuf::from(env::var("OUT_DIR")?);
    fs::write(out.join("descriptors.bin"), descriptors.encode_to_vec())?;
    tonic_prost_build::configure().compile_fds(descriptors)?;
    fs::write(out.join("models.rs"), models(Path::new("models"))?)?;
    Ok(())
}

/// Every model that is there, by the name of its file, with its bytes.
fn models(folder: &Path) -> Result<String, Box<dyn Error>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "onnx") {
            files.push(path);
        }
    }
    files.sort();
    let mut code = String::from("/// The models that are part of the binary.\n");
    code.push_str("const MODELS: &[(&str, &[u8])] = &[\n");
    for file in files {
        let name = file.file_name().and_then(|name| name.to_str()).ok_or("a model's name")?;
        // Not the whole path, so that a build that was moved with its sources still finds them.
        let path = format!("/{}", file.to_str().ok_or("a model's path")?);
        writeln!(
            code,
            "    ({name:?}, include_bytes!(concat!(env!(\"CARGO_MANIFEST_DIR\"), {path:?}))),"
        )?;
    }
    code.push_str("];\n");
    Ok(code)
}
