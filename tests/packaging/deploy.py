"""The files of deploy/ against their schemas, the Dockerfile, the binary and each other.

    python tests/packaging/deploy.py target/debug/voltour

Ends with `N passed, M failed`.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import dockerfile
import kubernetes_validate
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "client"))
from results import Results  # noqa: E402

DEPLOY = ROOT / "deploy"
KUBERNETES = "1.32"
EXPOSURE = 15  # a tenth of what `systemd-analyze security` gives, at most


def output(*command, **more):
    """Exit code, and all that a command says."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)
    return done.returncode, done.stdout


def seconds(text):
    return int(re.fullmatch(r"(\d+)s", str(text)).group(1))


def stop_within(binary):
    """What a stop takes at most, by default."""
    printed = output(binary, "config", "print")[1]
    return seconds(re.search(r'stop_within = "(.*)"', printed).group(1))


def compose(results, image, binary):
    path = DEPLOY / "compose.yaml"
    schema = pathlib.Path(sys.executable).with_name("check-jsonschema")
    code, said = output(schema, "--builtin-schema", "vendor.compose-spec", path)
    results.check("compose: keeps the schema", code == 0, said)
    service = yaml.safe_load(path.read_text())["services"]["voltour"]
    inside = [port.rsplit(":", 1)[1] for port in service["ports"]]
    results.check("compose: the image's ports", inside == image.last("EXPOSE").split(), inside)
    results.check("compose: on loopback", all(port.startswith("127.0.0.1:") for port in service["ports"]))
    mounted = [volume.split(":")[1] for volume in service["volumes"]]
    results.check("compose: the image's volume", mounted == image.last("VOLUME").split(), mounted)
    grace = seconds(service["stop_grace_period"])
    results.check("compose: time to end", grace > stop_within(binary), grace)
    results.check("compose: the health check is the image's", "healthcheck" not in service)


def documents():
    """Every document of the Kubernetes folder, by file."""
    for path in sorted((DEPLOY / "kubernetes").glob("*.yaml")):
        for document in yaml.safe_load_all(path.read_text()):
            yield path.name, document


def kubernetes(results, image, binary):
    by_kind = {}
    for name, document in documents():
        by_kind[document["kind"]] = document
        if document["kind"] == "Kustomization":
            missing = [file for file in document["resources"] if not (DEPLOY / "kubernetes" / file).is_file()]
            results.check(f"kubernetes: {name} names files that are there", not missing, missing)
            continue
        try:
            kubernetes_validate.validate(document, KUBERNETES, strict=True)
            fault = None
        except kubernetes_validate.ValidationError as error:
            fault = error
        results.check(f"kubernetes: {name} keeps the schema", fault is None, fault)
    pod = by_kind["StatefulSet"]["spec"]["template"]
    labels = pod["metadata"]["labels"].items()
    for kind in ["StatefulSet", "PodDisruptionBudget"]:
        selected = by_kind[kind]["spec"]["selector"]["matchLabels"].items()
        results.check(f"kubernetes: the {kind} selects the pod", selected <= labels, selected)
    selected = by_kind["Service"]["spec"]["selector"].items()
    results.check("kubernetes: the Service selects the pod", selected <= labels, selected)
    results.check("kubernetes: one replica", by_kind["StatefulSet"]["spec"]["replicas"] == 1)
    container = pod["spec"]["containers"][0]
    ports = {port["name"]: port["containerPort"] for port in container["ports"]}
    results.check("kubernetes: the image's ports", [str(port) for port in ports.values()]
                  == image.last("EXPOSE").split(), ports)
    targets = {(port["targetPort"], port["port"]) for port in by_kind["Service"]["spec"]["ports"]}
    results.check("kubernetes: the Service's ports", targets == set(ports.items()), targets)
    routes = json.loads((ROOT / "docs/openapi.json").read_text())["paths"]
    for probe in ["startupProbe", "livenessProbe", "readinessProbe"]:
        asks = container[probe]["httpGet"]
        results.check(f"kubernetes: the {probe} asks a route that is there", asks["path"] in routes
                      and asks["port"] == "rest", asks)
    user = f'{pod["spec"]["securityContext"]["runAsUser"]}:{pod["spec"]["securityContext"]["runAsGroup"]}'
    results.check("kubernetes: the image's user", user == image.last("USER"), user)
    grace = pod["spec"]["terminationGracePeriodSeconds"]
    results.check("kubernetes: time to end", grace > stop_within(binary), grace)
    given = {volume["name"] for volume in pod["spec"]["volumes"]}
    given |= {claim["metadata"]["name"] for claim in by_kind["StatefulSet"]["spec"]["volumeClaimTemplates"]}
    mounts = {mount["name"]: mount["mountPath"] for mount in container["volumeMounts"]}
    results.check("kubernetes: what is mounted is there", given == set(mounts), (given, mounts))
    results.check("kubernetes: the image's volume", mounts["data"] in image.last("VOLUME").split(), mounts)
    configured(results, by_kind, binary, mounts)


def configured(results, by_kind, binary, mounts):
    """The ConfigMap's file is good, and the Secret lies where it says."""
    text = by_kind["ConfigMap"]["data"]["voltour.toml"]
    token = re.search(r'bootstrap_token_file = "(.*)"', text).group(1)
    expected = [f'{mounts["token"]}/{key}' for key in by_kind["Secret"]["stringData"]]
    results.check("kubernetes: the Secret is where the configuration looks", [token] == expected, token)
    with tempfile.TemporaryDirectory() as directory:
        file, secret = pathlib.Path(directory) / "voltour.toml", pathlib.Path(directory) / "token"
        secret.write_text("a" * 64)
        file.write_text(text.replace(token, str(secret)))
        code, said = output(binary, "config", "check", "--config", file)
    results.check("kubernetes: the ConfigMap's file is good", code == 0, said)


def systemd(results, binary):
    path = DEPLOY / "systemd" / "voltour.service"
    command = re.search(r"^ExecStart=(.*)$", path.read_text(), re.M).group(1).split()
    code, said = output(binary, *command[1:], "--help")
    results.check("systemd: the command is one", code == 0, said)
    grace = int(re.search(r"^TimeoutStopSec=(\d+)$", path.read_text(), re.M).group(1))
    results.check("systemd: time to end", grace > stop_within(binary), grace)
    code, said = output(binary, "config", "check", "--config", DEPLOY / "voltour.toml")
    results.check("systemd: the sample configuration is good", code == 0, said)
    if shutil.which("systemd-analyze") is None:
        print("skip   systemd-analyze is not installed")
        return
    with tempfile.TemporaryDirectory() as directory:
        unit = pathlib.Path(directory) / path.name
        unit.write_text(path.read_text().replace(command[0], str(pathlib.Path(binary).resolve())))
        code, said = output("systemd-analyze", "verify", unit)
        results.check("systemd: the unit is well-formed", code == 0 and not said, said)
        code, said = output("systemd-analyze", "security", "--offline=true", f"--threshold={EXPOSURE}", unit)
        level = said.strip().splitlines()[-1]
        results.check(f"systemd: {level.strip('→ ')}", code == 0, said)


def alerts(results):
    """Every alert has its place in docs/operations.md, and nothing else has one there."""
    path = DEPLOY / "prometheus" / "alerts.yml"
    names = set(re.findall(r"^\s*- alert: (\w+)$", path.read_text(), re.M))
    headings = set(re.findall(r"^### (Voltour\w+)$", (ROOT / "docs/operations.md").read_text(), re.M))
    results.check("alerts: docs/operations.md says what to do about each", names == headings, names ^ headings)


def main():
    binary = sys.argv[1]
    # Whatever is configured where this runs says nothing about these files.
    for name in [name for name in os.environ if name.startswith("VOLTOUR_")]:
        del os.environ[name]
    results, image = Results(), dockerfile.read(ROOT / "Dockerfile")[None]
    compose(results, image, binary)
    kubernetes(results, image, binary)
    systemd(results, binary)
    alerts(results)
    return results.close()


if __name__ == "__main__":
    sys.exit(main())
