"""Solves compiled instances by OR-Tools CP-SAT: a path a line on standard input, an answer a line out.

    python cpsat.py --limit 60 < paths

One circuit goes through the end of the tour, the start and the candidates served; a candidate that is not served
has a loop of its own. The numbers are whole millimetres, milliseconds and millijoules, and every one is
rounded towards a weaker constraint: distances, durations and energies down, limits and rewards up. So
the model is a relaxation, less than a unit a stop away from the instance. A bound or an infeasibility that CP-SAT
proves therefore holds for the instance; its tour may break a limit by the rounding, which the caller recomputes.
"""

import argparse
import json
import math
import sys

from ortools.sat.python import cp_model

PER_UNIT = 1_000
"""Millimetres in a metre, and so on."""

SLOPE_DENOMINATOR = 1_000_000
"""A charge grows with the arrival by drain / transfer: a fraction with this denominator, rounded down."""


def down(value):
    # A product such as 0.3 x 1000 is not to lose a whole unit to its last bit.
    return math.floor(value * PER_UNIT + 1e-6)


def up(value):
    return math.ceil(value * PER_UNIT - 1e-6)


class Tour:
    """The model of one instance. Nodes are the instance's places: candidates, start, end."""

    def __init__(self, instance):
        self.instance = instance
        self.candidates = instance["candidates"]
        self.start, self.end = len(self.candidates), len(self.candidates) + 1
        self.distance_m = instance["distance_m"]
        self.maximise = instance["objective"] == "max_reward"
        self.model = cp_model.CpModel()
        self.useful = self.worth_serving()
        self.timed = instance["timespan_s"] is not None or any(
            c["due_s"] is not None for c in self.candidates
        )
        self.latest_s = [self.latest(i) for i in range(self.end + 1)]
        self.earliest_s = self.earliest()
        self.useful = [i for i in self.useful if self.reachable(i)]
        self.arc = self.arcs()
        self.served = {i: self.arc[i, i].Not() for i in self.useful}
        self.circuit()
        self.demands()
        if self.timed:
            self.times()
        if instance["capacity_j"] is not None:
            self.capacity()
        self.objective()
        self.hint()

    def worth_serving(self):
        """Where distances are a metric, the shortest tour never goes where nobody needs it."""
        everyone = range(len(self.candidates))
        if self.maximise or not self.instance["metric"]:
            return list(everyone)
        needed = {i for demand in self.instance["demands"] for i in demand["members"]}
        return [i for i in everyone if i in needed]

    # What is known of times and energies before any search.

    def travel_s(self, i, j):
        return self.distance_m[i][j] / self.instance["speed_mps"]

    def leave_s(self, i, arrive_s):
        """When the charger leaves a place at which it arrived then."""
        if i == self.start:
            return 0.0
        candidate, transfer_w = self.candidates[i], self.instance["transfer_w"]
        return arrive_s + (candidate["charge_j"] + candidate["drain_w"] * arrive_s) / transfer_w

    def latest(self, i):
        """The latest arrival, in seconds, by the deadline and by the way home; None without either."""
        timespan_s = self.instance["timespan_s"]
        if i >= self.start:
            return timespan_s
        due_s = self.candidates[i]["due_s"]
        if timespan_s is None:
            return due_s
        slope = 1 + self.candidates[i]["drain_w"] / self.instance["transfer_w"]
        home_s = (timespan_s - self.travel_s(i, self.end) - self.leave_s(i, 0.0)) / slope
        return home_s if due_s is None else min(due_s, home_s)

    def earliest(self):
        """The earliest arrivals, in seconds: straight from the start, or by a stop that makes it shorter."""
        ready_s = [c["ready_s"] for c in self.candidates]
        found = [max(ready_s[i], self.travel_s(self.start, i)) for i in range(self.start)]
        changed = not self.instance["metric"]
        while changed:
            changed = False
            for i in self.useful:
                for j in self.useful:
                    by_i = max(ready_s[j], self.leave_s(i, found[i]) + self.travel_s(i, j))
                    if i != j and by_i < found[j] - 1e-9:
                        found[j], changed = by_i, True
        return found + [0.0, self.travel_s(self.start, self.end)]

    def reachable(self, i):
        """Whether it can be served in time and, where distances are a metric, paid for."""
        if self.timed and self.latest_s[i] is not None and self.earliest_s[i] > self.latest_s[i]:
            return False
        capacity_j = self.instance["capacity_j"]
        if capacity_j is None or not self.instance["metric"]:
            return True
        way_m = self.distance_m[self.start][i] + self.distance_m[i][self.end]
        return way_m * self.instance["travel_jpm"] + self.candidates[i]["charge_j"] <= capacity_j

    def possible(self, i, j):
        """Whether the charger can go from one to the other and be in time, at least."""
        if self.timed and self.latest_s[j] is not None:
            if self.leave_s(i, self.earliest_s[i]) + self.travel_s(i, j) > self.latest_s[j]:
                return False
        capacity_j = self.instance["capacity_j"]
        if capacity_j is None or not self.instance["metric"]:
            return True
        way_m = self.distance_m[self.start][i] if i != self.start else 0.0
        way_m += self.distance_m[i][j]
        way_m += self.distance_m[j][self.end] if j != self.end else 0.0
        charge_j = sum(self.candidates[k]["charge_j"] for k in (i, j) if k < self.start)
        return way_m * self.instance["travel_jpm"] + charge_j <= capacity_j

    # The model.

    def arcs(self):
        """A literal for each way that can be gone, and for each stay that is allowed."""
        arc = {}
        for i in [*self.useful, self.start]:
            for j in [*self.useful, self.end]:
                if i == j or self.possible(i, j):
                    arc[i, j] = self.model.new_bool_var(f"arc_{i}_{j}")
        return arc

    def circuit(self):
        node = {place: index for index, place in enumerate([*self.useful, self.start, self.end])}
        arcs = [(node[i], node[j], literal) for (i, j), literal in self.arc.items()]
        self.model.add_circuit([*arcs, (node[self.end], node[self.start], True)])

    def demands(self):
        for demand in self.instance["demands"]:
            served = [self.served[i] for i in demand["members"] if i in self.served]
            if demand["needs"] == len(served):
                self.model.add_bool_and(served)
            elif demand["needs"] == 1:
                self.model.add_bool_or(served)
            else:
                self.model.add(sum(served) >= demand["needs"])

    def times(self):
        """Arrivals and departures, each no sooner than the stop before allows."""
        horizon_s = self.horizon()
        self.arrive, self.leave = {}, {}
        for i in self.useful:
            latest_s = horizon_s if self.latest_s[i] is None else self.latest_s[i]
            self.arrive[i] = self.model.new_int_var(down(self.earliest_s[i]), up(latest_s), f"arrive_{i}")
            self.leave[i] = self.departure(i, latest_s)
        if self.latest_s[self.end] is not None:
            earliest, latest = self.earliest_s[self.end], self.latest_s[self.end]
            self.arrive[self.end] = self.model.new_int_var(down(earliest), up(latest), "finish")
        for (i, j), literal in self.arc.items():
            # From the start the lower bound of the arrival says it.
            if i != j and i != self.start and j in self.arrive:
                way = down(self.travel_s(i, j))
                self.model.add(self.arrive[j] >= self.leave[i] + way).only_enforce_if(literal)

    def horizon(self):
        """No tour lasts longer, in seconds, wherever the charger goes next."""
        if all(self.latest_s[i] is not None for i in self.useful):
            return 0.0
        time_s = max(c["ready_s"] for c in self.candidates)
        for i in self.useful:
            time_s = self.leave_s(i, time_s) + max(self.travel_s(i, j) for j in self.useful)
        return time_s

    def departure(self, i, latest_s):
        drain_w, transfer_w = self.candidates[i]["drain_w"], self.instance["transfer_w"]
        arrive, constant = self.arrive[i], down(self.leave_s(i, 0.0))
        slope = math.floor(SLOPE_DENOMINATOR * drain_w / transfer_w + 1e-6)
        if slope == 0:
            return arrive + constant
        low, high = (down(self.leave_s(i, t)) for t in (self.earliest_s[i], latest_s))
        leave = self.model.new_int_var(low - 2, high + 2, f"leave_{i}")
        # One less than the denominator: the departure is the quotient rounded down.
        grown = (SLOPE_DENOMINATOR + slope) * arrive - (SLOPE_DENOMINATOR - 1)
        self.model.add(SLOPE_DENOMINATOR * (leave - constant) >= grown)
        return leave

    def capacity(self):
        per_m = self.instance["travel_jpm"]
        spent = [
            down(self.distance_m[i][j] * per_m) * literal
            for (i, j), literal in self.arc.items()
            if i != j
        ]
        charged = [down(self.candidates[i]["charge_j"]) * self.served[i] for i in self.useful]
        self.model.add(sum(spent) + sum(charged) <= up(self.instance["capacity_j"]))

    def objective(self):
        if self.maximise:
            rewards = [up(self.candidates[i]["reward"]) * self.served[i] for i in self.useful]
            self.model.maximize(sum(rewards))
            return
        ways = [down(self.distance_m[i][j]) * arc for (i, j), arc in self.arc.items() if i != j]
        self.model.minimize(sum(ways))

    def hint(self):
        """The greedy tour, without the stops that the model left out."""
        stops = [i for i in self.instance["hint"] if i in self.served]
        places = [self.start, *stops, self.end]
        taken = set(zip(places, places[1:])) | {(i, i) for i in self.useful if i not in stops}
        for way, literal in self.arc.items():
            self.model.add_hint(literal, way in taken)

    # The answer.

    def solve(self, limit_s, workers):
        solver = cp_model.CpSolver()
        solver.parameters.max_time_in_seconds = limit_s
        solver.parameters.num_workers = workers
        status = solver.solve(self.model)
        known = status in (cp_model.OPTIMAL, cp_model.FEASIBLE)
        return {
            "status": solver.status_name(status),
            "wall_s": solver.wall_time,
            "bound": self.bound(solver) if known else None,
            "order": self.order(solver) if known else None,
        }

    def bound(self, solver):
        return solver.best_objective_bound / PER_UNIT

    def order(self, solver):
        after = {i: j for (i, j), arc in self.arc.items() if i != j and solver.boolean_value(arc)}
        order, place = [], after[self.start]
        while place != self.end:
            order.append(self.candidates[place]["request"])
            place = after[place]
        return order


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--limit", type=float, required=True, help="seconds for each instance")
    parser.add_argument("--workers", type=int, default=2)
    arguments = parser.parse_args()
    for line in sys.stdin:
        with open(line.strip()) as file:
            instance = json.load(file)
        answer = Tour(instance).solve(arguments.limit, arguments.workers)
        print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
