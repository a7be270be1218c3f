"""Schemathesis, from the OpenAPI document that a running server serves.

    python tests/client/contract.py target/debug/voltour

Starts the binary, gives it a network, requests and a plan, and lets Schemathesis ask whatever the document allows and
forbids: no answer may be a server error, and none may be one that the document does not describe. Ends with the exit code
of Schemathesis.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import urllib.error

import grpc
from round import PATIENCE, Client, Server, at, fetch, generate

HERE = pathlib.Path(__file__).resolve().parent
EXAMPLES = 25  # an operation, of each kind; the run is to stay within a minute


def fill(client):
    """Makes one thing of each kind; their ids by the start of their address."""
    client.networks.Put(client.put(), timeout=PATIENCE)
    request = client.requests.Submit(client.submit("s1", deadline=at(600), reward=2), timeout=PATIENCE)
    client.requests.Submit(client.submit("s2"), timeout=PATIENCE)
    departure = client.departures.Announce(client.announce(), timeout=PATIENCE)
    tour = client.tours.GetNext(client.next(), timeout=PATIENCE)
    client.requests.Submit(client.submit("s3"), timeout=PATIENCE)
    return {"/v1/networks/": "field", "/v1/requests/": request.id,
            "/v1/departures/": departure.id, "/v1/plans/": tour.plan_id}


def explained(rest, plan):
    """Waits until the plan is explained, so that no answer changes from one call to the next."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        try:
            fetch(f"{rest}/v1/plans/{plan}/explanation")
            return
        except urllib.error.HTTPError:
            time.sleep(0.1)
    raise SystemExit("the plan was never explained")


def schemathesis(rest, ids, directory):
    """Runs it; its exit code."""
    program = pathlib.Path(sys.executable).with_name("schemathesis")
    environment = os.environ | {"PYTHONPATH": str(HERE), "SCHEMATHESIS_HOOKS": "contract_hooks",
                                "VOLTOUR_IDS": json.dumps(ids)}
    arguments = ["run", f"{rest}/openapi.json", "--seed", "1", "--max-examples", str(EXAMPLES),
                 "--phases", "examples,coverage,fuzzing", "--continue-on-failure", "--no-shrink",
                 # A cursor is opaque: the document cannot say which text is one.
                 "--exclude-checks", "positive_data_acceptance"]
    return subprocess.run([program, *arguments], env=environment, cwd=directory).returncode


def main():
    with tempfile.TemporaryDirectory() as directory:
        directory = pathlib.Path(directory)
        (directory / "stubs").mkdir()
        messages, stubs = generate(directory / "stubs")
        server = Server(sys.argv[1], directory)
        code = 1
        try:
            with grpc.insecure_channel(server.grpc) as channel:
                ids = fill(Client(messages, stubs, channel))
            explained(server.rest, ids["/v1/plans/"])
            code = schemathesis(server.rest, ids, directory)
        finally:
            stopped = server.stop()
            if code or stopped:
                print(f"--- the server's log\n{server.logged()}---")
            server.log.close()
    return code or (0 if stopped == 0 else 1)


if __name__ == "__main__":
    sys.exit(main())
