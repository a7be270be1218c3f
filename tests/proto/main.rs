//! The gRPC contract as text: written as its readers expect, and nothing taken back that was once released.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

mod breaking;
mod lint;

use prost_types::FileDescriptorSet;
use protox::prost_reflect::DescriptorPool;

/// The contract below a folder, with its comments.
fn compiled(folder: &str) -> FileDescriptorSet {
    let root = format!("{}/{folder}", env!("CARGO_MANIFEST_DIR"));
    let files = std::fs::read_dir(format!("{root}/voltour/v1")).unwrap();
    let mut names: Vec<_> =
        files.map(|file| file.unwrap().file_name().into_string().unwrap()).collect();
    names.retain(|name| name.ends_with(".proto"));
    names.sort();
    let mut compiler = protox::Compiler::new([root]).unwrap();
    compiler.include_imports(true).include_source_info(true);
    compiler.open_files(names.iter().map(|name| format!("voltour/v1/{name}"))).unwrap();
    compiler.file_descriptor_set()
}

fn pool(files: FileDescriptorSet) -> DescriptorPool {
    DescriptorPool::from_file_descriptor_set(files).unwrap()
}

/// Whether it is ours: the imports are not.
fn is_ours(full_name: &str) -> bool {
    full_name.starts_with("voltour.")
}
