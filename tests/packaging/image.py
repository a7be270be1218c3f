"""The steps of the Dockerfile without a container engine, and the service out of what they make.

    python tests/packaging/image.py                        # builds as the Dockerfile does: a quarter of an hour
    python tests/packaging/image.py target/debug/voltour   # takes this binary for what its `cargo build` makes

The stage that builds becomes a folder: COPY copies into it, RUN runs in it. The last stage becomes another, which starts
with what its base image has (the libraries that the binary links, which must all be among those of the base), and into
which the Dockerfile's steps lay the rest. The service then starts there as the image would start it: with that folder for
its root, in a network of its own, as the image's user, with the image's environment and nothing else but a bootstrap token.
Needs Linux and root, or user namespaces. Ends with `N passed, M failed`.
"""

import fcntl
import json
import os
import pathlib
import re
import secrets
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import urllib.error
import urllib.request

import dockerfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "client"))
from results import Results  # noqa: E402

CACHE = ROOT / "target" / "image"
PATIENCE = 30  # seconds
# What gcr.io/distroless/cc-debian12 has of what a Rust binary may link.
BASE_LIBRARIES = {"libc.so.6", "libm.so.6", "libgcc_s.so.1", "libdl.so.2", "libpthread.so.0", "librt.so.1",
                  "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
BASE_GLIBC = (2, 36)
SIOCSIFFLAGS, IFF_UP = 0x8914, 1


def lay(stage, folder, stages, folders):
    """Follows WORKDIR and COPY into the folder; owners are left to `own`."""
    at = folder
    for kind, step in stage.steps:
        if kind == "WORKDIR":
            at = folder / step.lstrip("/")
            at.mkdir(parents=True, exist_ok=True)
        elif kind == "COPY":
            options, sources, target = dockerfile.copy(step)
            start = folders[options["from"]] if "from" in options else ROOT
            goal = folder / target.lstrip("/") if target.startswith("/") else at / target
            for source in sources:
                into = goal / source if target.endswith("/") else goal
                put(start / source.lstrip("/"), into)
        elif kind == "RUN":
            build(step, folder, at)
    return at


def put(source, goal):
    goal.parent.mkdir(parents=True, exist_ok=True)
    if source.is_dir():
        shutil.copytree(source, goal, dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))
    else:
        shutil.copy2(source, goal)


def build(step, folder, at):
    """Runs a RUN; the image's absolute paths are the stage's, so they get its folder before them."""
    caches, commands = dockerfile.run(step)
    cargo = [command for command in commands if command.startswith("cargo build")]
    assert len(cargo) == 1, f"one `cargo build` was expected: {commands}"
    if len(sys.argv) > 1:
        profile = folder / "build" / "target" / "release"
        profile.mkdir(parents=True)
        shutil.copy2(sys.argv[1], profile / "voltour")
        commands.remove(cargo[0])
        # That everything is there which the manifest names can be told without building.
        subprocess.run(["cargo", "metadata", "--locked", "--no-deps", "--format-version=1"], cwd=at, check=True,
                       stdout=subprocess.DEVNULL)
    else:
        for cache in caches:
            kept = CACHE / cache.strip("/").replace("/", "-")
            if cache.startswith("/build/"):
                kept.mkdir(parents=True, exist_ok=True)
                (folder / cache.lstrip("/")).symlink_to(kept)
    moved = [re.sub(r"(?<=\s)/out", f"{folder}/out", command) for command in commands]
    subprocess.run(["sh", "-euc", " && ".join(moved)], cwd=at, check=True)


def base(folder, binary, results):
    """What the last stage's base image has of what the binary needs."""
    linked = subprocess.run(["ldd", binary], check=True, capture_output=True, text=True).stdout
    libraries = [pathlib.Path(path) for path in re.findall(r"(/\S+)", linked)]
    strange = {path.name for path in libraries} - BASE_LIBRARIES
    results.check("links nothing that the base image lacks", not strange, strange)
    symbols = set(re.findall(rb"GLIBC_(\d+)\.(\d+)", binary.read_bytes()))
    newest = max((int(major), int(minor)) for major, minor in symbols)
    results.check(f"needs no newer glibc than the base image's: {newest}", newest <= BASE_GLIBC, newest)
    for path in libraries:
        put(path.resolve(), folder / str(path).lstrip("/"))


def own(stage, folder):
    """What COPY --chown says; all else is root's, and not to be written."""
    for step in stage.of("COPY"):
        options, _, target = dockerfile.copy(step)
        if "chown" in options:
            user, group = options["chown"].split(":")
            for path in [folder / target.lstrip("/"), *(folder / target.lstrip("/")).rglob("*")]:
                os.chown(path, int(user), int(group))


def loopback_up():
    """A new network has its loopback down."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        fcntl.ioctl(any_socket, SIOCSIFFLAGS, struct.pack("16sh22x", b"lo", IFF_UP))


def asked(path, token=None):
    """The status of a REST route."""
    headers = {"Authorization": f"Bearer {token}"} if token else {}
    request = urllib.request.Request(f"http://127.0.0.1:7480{path}", headers=headers)
    try:
        with urllib.request.urlopen(request, timeout=PATIENCE) as answer:
            return answer.status
    except urllib.error.HTTPError as error:
        return error.code


def start(stage, folder, words, **more):
    """A process as the image would run it."""
    command = [shutil.which("chroot"), f"--userspec={stage.last('USER')}", folder, *words]
    return subprocess.Popen(command, env=dockerfile.environment(stage) | more,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def serve(stage, folder, results):
    """The service out of the layout: refuses to stand open, starts with a token, is healthy, ends."""
    command = dockerfile.words(stage.last("ENTRYPOINT")) + dockerfile.words(stage.last("CMD"))
    health = dockerfile.healthcheck(stage)
    open_to_all = start(stage, folder, command)
    said = open_to_all.communicate(timeout=PATIENCE)[1]
    results.check("without a token it refuses to listen to all", open_to_all.returncode == 2
                  and "BOOTSTRAP_TOKEN" in said, said)
    token = secrets.token_hex(32)
    service = start(stage, folder, command, VOLTOUR_ACCESS__BOOTSTRAP_TOKEN=token)
    line = service.stdout.readline()
    results.check("with one it gets ready", line.startswith("voltour ready "), line or service.poll())
    status = pathlib.Path(f"/proc/{service.pid}/status").read_text(encoding="utf-8")
    user = stage.last("USER").split(":")[0]
    results.check("not as root", re.search(r"^Uid:\t(\d+)", status, re.M).group(1) == user, status)
    checked = start(stage, folder, health)
    results.check("the health check passes", checked.wait(PATIENCE) == 0, checked.stderr.read())
    results.check("/readyz says so too", (code := asked("/readyz")) == 200, code)
    results.check("without the token nothing is told", (code := asked("/v1/networks")) == 401, code)
    results.check("with it everything", (code := asked("/v1/networks", token)) == 200, code)
    service.send_signal(signal.Signals[stage.last("STOPSIGNAL")])
    said = service.communicate(timeout=PATIENCE)[1]
    results.check("the stop signal ends it well", service.returncode == 0, said)
    lines = [json.loads(line) for line in said.splitlines()]
    results.check("its log is JSON, and does not tell the token", lines and token not in said, said)
    checked = start(stage, folder, health)
    results.check("the health check fails once it has ended", checked.wait(PATIENCE) == 1, checked.returncode)
    volume = folder / stage.last("VOLUME").lstrip("/")
    results.check("the database lies in the volume", (volume / "voltour.db").is_file(), list(volume.iterdir()))


def main():
    loopback_up()
    results, stages = Results(), dockerfile.read(ROOT / "Dockerfile")
    last = stages[None]
    with tempfile.TemporaryDirectory() as directory:
        folders = {name: pathlib.Path(directory) / (name or "image") for name in stages}
        for name, folder in folders.items():
            folder.mkdir()
            folder.chmod(0o755)
        pathlib.Path(directory).chmod(0o755)
        built, image = folders["build"], folders[None]
        lay(stages["build"], built, stages, folders)
        binary = next(built.glob("out/voltour"))
        base(image, binary, results)
        lay(last, image, stages, folders)
        own(last, image)
        files = sorted(str(path.relative_to(image)) for path in image.rglob("*") if path.is_file())
        strange = [name for name in files if not re.match(r"(lib|lib64|usr/lib)/|usr/local/bin/voltour$", name)]
        results.check("the image holds the binary and its libraries, no shell", not strange, strange)
        exposed = last.last("EXPOSE").split()
        listened = [value.rsplit(":", 1)[1] for key, value in dockerfile.environment(last).items()
                    if key.endswith("__LISTEN")]
        results.check("it exposes what it listens on", exposed == listened, (exposed, listened))
        serve(last, image, results)
    return results.close()


if __name__ == "__main__":
    if os.environ.get("VOLTOUR_IMAGE_APART") is None:
        # In a network of its own, so that the image's ports are free.
        os.environ["VOLTOUR_IMAGE_APART"] = "1"
        apart = ["unshare", "--net"] + ([] if os.geteuid() == 0 else ["--map-root-user", "--map-auto"])
        os.execvp("unshare", [*apart, sys.executable, *sys.argv])
    sys.exit(main())
