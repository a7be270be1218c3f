"""A client made of nothing but `proto/`: the whole round against a real server.

    python tests/client/round.py target/debug/voltour

Generates the stubs into a temporary directory, starts the binary on free ports over a temporary
database, and drives it as a base station, a charger and an operator would. Prints what it did; ends
with `N passed, M failed` and the exit code 0 or 1.
"""

import importlib
import importlib.resources
import json
import math
import pathlib
import queue
import subprocess
import sys
import tempfile
import threading
import time
import urllib.error
import urllib.request
from concurrent import futures

import grpc
from google.protobuf import timestamp_pb2
from google.rpc import error_details_pb2
from grpc_health.v1 import health_pb2, health_pb2_grpc
from grpc_reflection.v1alpha import reflection_pb2
from grpc_status import rpc_status
from grpc_tools import protoc
from results import Results

ROOT = pathlib.Path(__file__).resolve().parents[2]
PATIENCE = 30  # seconds; a passing run never waits so long
CONFIG = """
[grpc]
listen = "127.0.0.1:0"
[rest]
listen = "127.0.0.1:0"
[store]
path = {store}
[planning]
budget = "150ms"
lead = "400ms"
"""


def generate(out):
    """Generates the stubs from `proto/` alone, and imports them."""
    files = sorted((ROOT / "proto" / "voltour" / "v1").glob("*.proto"))
    wellknown = importlib.resources.files("grpc_tools") / "_proto"
    options = [f"--proto_path={ROOT / 'proto'}", f"--proto_path={wellknown}"]
    options += [f"--python_out={out}", f"--grpc_python_out={out}"]
    if protoc.main(["protoc", *options, *map(str, files)]) != 0:
        raise SystemExit("the stubs cannot be generated")
    sys.path.insert(0, str(out))
    names = [file.stem for file in files]
    messages = {name: importlib.import_module(f"voltour.v1.{name}_pb2") for name in names}
    stubs = {name: importlib.import_module(f"voltour.v1.{name}_pb2_grpc") for name in names}
    return messages, stubs


class Server:
    """The binary over a database of its own; ended by SIGTERM."""

    def __init__(self, binary, directory):
        config = directory / "voltour.toml"
        config.write_text(CONFIG.format(store=json.dumps(str(directory / "voltour.db"))))
        self.log = open(directory / "stderr.log", "w+", encoding="utf-8")
        self.process = subprocess.Popen(
            [binary, "serve", "--config", str(config)],
            stdout=subprocess.PIPE, stderr=self.log, text=True,
        )
        lines = queue.Queue()
        threading.Thread(target=self.read, args=(lines,), daemon=True).start()
        try:
            words = lines.get(timeout=PATIENCE).split()
            addresses = dict(word.split("=", 1) for word in words[2:])
            self.grpc = addresses["grpc"].removeprefix("http://")
            self.rest = addresses["rest"]
        except (queue.Empty, KeyError, ValueError):
            self.process.kill()
            raise SystemExit(f"the server never got ready:\n{self.logged()}") from None

    def read(self, lines):
        for line in self.process.stdout:
            lines.put(line)

    def logged(self):
        self.log.flush()
        self.log.seek(0)
        return self.log.read()

    def stop(self):
        self.process.terminate()
        try:
            return self.process.wait(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            self.process.kill()
            return "killed"


def at(seconds):
    """A time so many seconds from now."""
    stamp = timestamp_pb2.Timestamp()
    stamp.FromNanoseconds(int((time.time() + seconds) * 1e6) * 1000)
    return stamp


class Client:
    """The four services, and one message builder a call."""

    def __init__(self, messages, stubs, channel):
        self.common, self.network = messages["common"], messages["network"]
        self.request, self.departure = messages["request"], messages["departure"]
        self.tour = messages["tour"]
        self.networks = stubs["network"].NetworkServiceStub(channel)
        self.requests = stubs["request"].RequestServiceStub(channel)
        self.departures = stubs["departure"].DepartureServiceStub(channel)
        self.tours = stubs["tour"].TourServiceStub(channel)
        self.calls = 0

    def client_id(self):
        self.calls += 1
        return f"python-{self.calls}"

    def place(self, x, y):
        return self.common.Place(position_m=self.common.Point(x_m=x, y_m=y))

    def put(self, **fields):
        n = self.network
        sensors = [n.Sensor(id=f"s{i}", place=self.place(10 * i, 0), battery_j=100) for i in range(1, 4)]
        truck = n.ChargerType(
            name="truck", speed_mps=10, travel_jpm=1, transfer_w=20,
            start_m=self.common.Point(x_m=0, y_m=0),
        )
        spec = n.NetworkSpec(objective=n.OBJECTIVE_MAX_REWARD, charger_types=[truck], sensors=sensors)
        fields = {"client_id": self.client_id(), "network_id": "field", "spec": spec} | fields
        return n.PutNetworkRequest(**fields)

    def submit(self, sensor="s1", **fields):
        fields = {"client_id": self.client_id(), "network_id": "field", "sensor_id": sensor} | fields
        return self.request.SubmitRequest(**fields)

    def announce(self, charger="A", **fields):
        fields = {"client_id": self.client_id(), "network_id": "field", "charger_id": charger} | fields
        return self.departure.AnnounceRequest(**fields)

    def next(self, charger="A", **fields):
        fields = {"network_id": "field", "charger_id": charger} | fields
        return self.tour.GetNextRequest(**fields)

    def visit(self, tour, sensor="s1", **fields):
        fields = {"client_id": self.client_id(), "tour_id": tour, "sensor_id": sensor,
                  "outcome": self.tour.VISIT_OUTCOME_CHARGED} | fields
        return self.tour.ReportVisitRequest(**fields)

    def complete(self, tour, **fields):
        return self.tour.CompleteRequest(**({"client_id": self.client_id(), "tour_id": tour} | fields))


def the_round(client, rest, results):
    """What a base station, a charger and an operator do, from Put to the history."""
    network = client.networks.Put(client.put(), timeout=PATIENCE)
    results.check("Put makes version 1", (network.version, network.sensor_count) == (1, 3), network)
    again = client.put(client_id="python-1")
    results.check("the same Put gets the same answer",
                  client.networks.Put(again, timeout=PATIENCE) == network)

    request = client.requests.Submit(client.submit("s1", deadline=at(600)), timeout=PATIENCE)
    results.check("Submit stores an open request",
                  request.state == client.request.REQUEST_STATE_OPEN, request)
    items = [client.submit("s2"), client.submit("s3", residual_j=-1), client.submit("s3")]
    answers = list(client.requests.SubmitStream(iter(items), timeout=PATIENCE))
    kinds = [answer.WhichOneof("result") for answer in answers]
    results.check("SubmitStream answers each item, the bad one with its own refusal",
                  kinds == ["request", "refused", "request"]
                  and [a.position for a in answers] == [0, 1, 2]
                  and answers[1].refused.code == grpc.StatusCode.INVALID_ARGUMENT.value[0]
                  and answers[1].refused.field_violations[0].field == "residual_j", answers)

    # A charger that waits before its departure is planned.
    departure = client.departures.Announce(client.announce(t0=at(2)), timeout=PATIENCE)
    with futures.ThreadPoolExecutor() as pool:
        waiting = pool.submit(client.tours.GetNext, client.next(), timeout=PATIENCE)
        tour = waiting.result(timeout=PATIENCE)
    results.check("GetNext waits for the tour of the departure",
                  tour.departure_id == departure.id
                  and sorted(stop.sensor_id for stop in tour.stops) == ["s1", "s2", "s3"], tour)
    results.check("GetNext returns it again", client.tours.GetNext(client.next(), timeout=PATIENCE) == tour)

    visit = client.tours.ReportVisit(
        client.visit(tour.id, arrived_at=at(-2), departed_at=at(-1), charge_j=100), timeout=PATIENCE)
    results.check("ReportVisit serves the request", list(visit.served_request_ids) == [request.id], visit)
    over = client.tours.Complete(client.complete(tour.id), timeout=PATIENCE)
    results.check("Complete ends the tour", over.state == client.tour.TOUR_STATE_COMPLETED, over)
    list_open = client.request.ListRequestsRequest(
        network_id="field", states=[client.request.REQUEST_STATE_OPEN])
    left = client.requests.List(list_open, timeout=PATIENCE).requests
    results.check("what was not charged is open again",
                  sorted(r.submitted.sensor_id for r in left) == ["s2", "s3"], left)
    history(tour, rest, results)


def fetch(address):
    with urllib.request.urlopen(address, timeout=PATIENCE) as answer:
        return json.load(answer)


def history(tour, rest, results):
    """The operator's view of the same round."""
    plans = fetch(f"{rest}/v1/plans?network=field")["items"]
    results.check("the plan is in the history", [plan["id"] for plan in plans] == [tour.plan_id], plans)
    envelope = fetch(f"{rest}/v1/plans/{tour.plan_id}")
    stops = [stop["sensor"] for stop in envelope["plan"]["stops"]]
    results.check("with the stops that the charger got",
                  stops == [stop.sensor_id for stop in tour.stops], stops)
    served = fetch(f"{rest}/v1/requests?network=field&state=served")["items"]
    results.check("and the request that was served", [r["sensor_id"] for r in served] == ["s1"], served)
    try:
        fetch(f"{rest}/v1/plans/nothing")
        results.check("a bad id is refused", False, "accepted")
    except urllib.error.HTTPError as problem:
        kind = problem.headers.get_content_type()
        results.check("a bad id gets a problem document",
                      problem.code in (400, 404) and kind == "application/problem+json",
                      (problem.code, kind))


def bad_inputs(client):
    """Calls with one bad field each, and its path."""
    spec = client.put().spec
    broken = type(spec)()
    broken.CopyFrom(spec)
    broken.sensors[2].battery_j = math.nan
    put, submit = client.networks.Put, client.requests.Submit
    announce, get_next = client.departures.Announce, client.tours.GetNext
    report, complete = client.tours.ReportVisit, client.tours.Complete
    return [
        ("spec", put, client.put(spec=None)),
        ("spec.sensors[2].battery_j", put, client.put(spec=broken)),
        ("network_id", put, client.put(network_id="no network")),
        ("client_id", put, client.put(client_id="")),
        ("sensor_id", submit, client.submit("unknown")),
        ("sensor_id", submit, client.submit("")),
        ("residual_j", submit, client.submit(residual_j=math.inf)),
        ("drain_w", submit, client.submit(drain_w=-1)),
        ("reward", submit, client.submit(reward=math.nan)),
        ("ready", submit, client.submit(ready=at(20), deadline=at(10))),
        ("place.position_m.x_m", submit, client.submit(place=client.place(math.nan, 0))),
        ("deadline.nanos", submit, client.submit(deadline=timestamp_pb2.Timestamp(seconds=1, nanos=-1))),
        ("t0", announce, client.announce(t0=at(8 * 86400))),
        ("t0", announce, client.announce(t0=at(-600))),
        ("capacity_j", announce, client.announce(capacity_j=-1)),
        ("charger_type", announce, client.announce(charger_type="bicycle")),
        ("charger_id", announce, client.announce(charger="")),
        ("departure_id", get_next, client.next(departure_id="7")),
        ("tour_id", report, client.visit("7")),
        ("tour_id", complete, client.complete("")),
    ]


def refusals(client, results):
    """Every bad input names its field in the details of the status."""
    for field, call, message in bad_inputs(client):
        what = f"INVALID_ARGUMENT names {field}"
        try:
            call(message, timeout=PATIENCE)
            results.check(what, False, "accepted")
            continue
        except grpc.RpcError as error:
            status, named = rpc_status.from_call(error), []
        for detail in status.details if status else []:
            bad = error_details_pb2.BadRequest()
            if detail.Unpack(bad):
                named += [violation.field for violation in bad.field_violations]
        refused = status is not None and status.code == grpc.StatusCode.INVALID_ARGUMENT.value[0]
        results.check(what, refused and named == [field], status)


def introspection(channel, results):
    """Health and reflection."""
    health = health_pb2_grpc.HealthStub(channel)
    answer = health.Check(health_pb2.HealthCheckRequest(), timeout=PATIENCE)
    results.check("health says serving", answer.status == health_pb2.HealthCheckResponse.SERVING, answer)
    # The messages of reflection v1 are those of v1alpha, which the library has.
    for version in ("v1", "v1alpha"):
        call = channel.stream_stream(
            f"/grpc.reflection.{version}.ServerReflection/ServerReflectionInfo",
            request_serializer=reflection_pb2.ServerReflectionRequest.SerializeToString,
            response_deserializer=reflection_pb2.ServerReflectionResponse.FromString,
        )
        question = reflection_pb2.ServerReflectionRequest(list_services="")
        answer = next(iter(call(iter([question]), timeout=PATIENCE)))
        names = [service.name for service in answer.list_services_response.service]
        wanted = {f"voltour.v1.{name}Service" for name in ("Network", "Request", "Departure", "Tour")}
        results.check(f"reflection {version} lists the services", wanted <= set(names), names)


def main():
    results = Results()
    with tempfile.TemporaryDirectory() as directory:
        directory = pathlib.Path(directory)
        (directory / "stubs").mkdir()
        messages, stubs = generate(directory / "stubs")
        server = Server(sys.argv[1], directory)
        print(f"the server listens at {server.grpc} and {server.rest}")
        try:
            with grpc.insecure_channel(server.grpc) as channel:
                client = Client(messages, stubs, channel)
                the_round(client, server.rest, results)
                refusals(client, results)
                introspection(channel, results)
        except Exception as error:  # a call that must succeed did not
            results.check("the round", False, repr(error))
        results.check("SIGTERM ends it with exit code 0", (code := server.stop()) == 0, code)
        if results.failed:
            print(f"--- the server's log\n{server.logged()}---")
        server.log.close()
    return results.close()


if __name__ == "__main__":
    sys.exit(main())
