-- The first schema. Ids are text (UUIDv7 where the service makes them), times are whole microseconds
-- since the Unix epoch in UTC (`*_us`), documents are JSON. Rows that a watch follows carry `change`,
-- a number of which each row that a transaction touches gets the next. Append-only: later schemas are later files.

-- Networks: the present version of each.
CREATE TABLE networks (
    id          TEXT    PRIMARY KEY,
    version     INTEGER NOT NULL,
    created_us  INTEGER NOT NULL,
    updated_us  INTEGER NOT NULL
) STRICT;

-- Every version of a network, kept so that a plan can always be explained.
CREATE TABLE network_versions (
    network_id   TEXT    NOT NULL REFERENCES networks (id),
    version      INTEGER NOT NULL,
    spec         BLOB    NOT NULL, -- JSON, compressed with zstd
    sensor_count INTEGER NOT NULL,
    created_us   INTEGER NOT NULL,
    PRIMARY KEY (network_id, version)
) STRICT;

-- Trajectories that came after the network's version; they replace the registered place.
CREATE TABLE trajectories (
    network_id  TEXT    NOT NULL REFERENCES networks (id),
    sensor_id   TEXT    NOT NULL,
    waypoints   TEXT    NOT NULL, -- JSON
    updated_us  INTEGER NOT NULL,
    PRIMARY KEY (network_id, sensor_id)
) STRICT;

-- Sensors taken for dead: their request expired, and neither a visit nor a newer request came since.
CREATE TABLE dead_sensors (
    network_id  TEXT    NOT NULL REFERENCES networks (id),
    sensor_id   TEXT    NOT NULL,
    request_id  TEXT    NOT NULL,
    since_us    INTEGER NOT NULL,
    PRIMARY KEY (network_id, sensor_id)
) STRICT;

-- The calls whose answers are remembered and that make no row of their own.
CREATE TABLE calls (
    scope        TEXT    NOT NULL, -- which call, on what
    client_id    TEXT    NOT NULL,
    fingerprint  BLOB    NOT NULL, -- SHA-256 of the content
    answer       TEXT    NOT NULL, -- JSON: what to read again for the answer
    created_us   INTEGER NOT NULL,
    PRIMARY KEY (scope, client_id)
) STRICT;

-- Charging requests.
CREATE TABLE requests (
    id            TEXT    PRIMARY KEY,
    network_id    TEXT    NOT NULL REFERENCES networks (id),
    sensor_id     TEXT    NOT NULL,
    client_id     TEXT    NOT NULL,
    fingerprint   BLOB    NOT NULL,
    state         TEXT    NOT NULL CHECK (state IN
        ('open', 'batched', 'planned', 'served', 'expired', 'withdrawn', 'superseded')),
    place         TEXT,             -- JSON; the registered place if null
    deadline_us   INTEGER,
    ready_us      INTEGER,
    residual_j    REAL,
    measured_us   INTEGER,          -- the receipt if null
    drain_w       REAL,
    reward        REAL,
    required      INTEGER NOT NULL,
    withdraw_us   INTEGER,          -- taken back while its batch was frozen
    departure_id  TEXT,             -- in whose batch it is or was last
    tour_id       TEXT,             -- of which it is or was a stop last
    received_us   INTEGER NOT NULL,
    updated_us    INTEGER NOT NULL,
    change        INTEGER NOT NULL
) STRICT;
CREATE UNIQUE INDEX requests_client ON requests (network_id, client_id);
-- A sensor has at most one request that waits, and at most one that is being dealt with.
CREATE UNIQUE INDEX requests_open ON requests (network_id, sensor_id) WHERE state = 'open';
CREATE UNIQUE INDEX requests_held ON requests (network_id, sensor_id)
    WHERE state IN ('batched', 'planned');
CREATE INDEX requests_batch ON requests (departure_id) WHERE departure_id IS NOT NULL;
CREATE INDEX requests_change ON requests (network_id, change);

-- Departures.
CREATE TABLE departures (
    id               TEXT    PRIMARY KEY,
    network_id       TEXT    NOT NULL REFERENCES networks (id),
    charger_id       TEXT    NOT NULL,
    charger_type     TEXT    NOT NULL,
    client_id        TEXT    NOT NULL,
    fingerprint      BLOB    NOT NULL,
    announced        TEXT    NOT NULL, -- JSON: what was announced
    state            TEXT    NOT NULL CHECK (state IN
        ('announced', 'closed', 'planned', 'completed', 'overdue', 'cancelled', 'missed')),
    t0_us            INTEGER NOT NULL,
    close_us         INTEGER NOT NULL, -- when it closes, or was closed
    start_us         INTEGER,          -- second 0, once closed
    network_version  INTEGER,          -- planned on, once closed
    batch_size       INTEGER NOT NULL DEFAULT 0,
    reason           TEXT,
    announced_us     INTEGER NOT NULL,
    updated_us       INTEGER NOT NULL,
    change           INTEGER NOT NULL
) STRICT;
CREATE UNIQUE INDEX departures_client ON departures (network_id, client_id);
CREATE INDEX departures_queue ON departures (network_id, t0_us, id)
    WHERE state IN ('announced', 'closed');
CREATE INDEX departures_change ON departures (network_id, change);
CREATE INDEX departures_charger ON departures (network_id, charger_id, id);

-- Plans: at most one of each revision of a departure.
CREATE TABLE plans (
    id             TEXT    PRIMARY KEY,
    departure_id   TEXT    NOT NULL REFERENCES departures (id),
    revision       INTEGER NOT NULL,
    network_id     TEXT    NOT NULL,
    charger_id     TEXT    NOT NULL,
    status         TEXT    NOT NULL,
    solver         TEXT    NOT NULL,
    objective      REAL    NOT NULL,
    bound          REAL,
    distance_m     REAL    NOT NULL,
    stop_count     INTEGER NOT NULL,
    unserved_count INTEGER NOT NULL,
    start_us       INTEGER NOT NULL,
    finish_us      INTEGER NOT NULL,
    envelope       BLOB    NOT NULL, -- JSON {plan, provenance}, compressed with zstd
    scenario       BLOB    NOT NULL, -- JSON, compressed with zstd
    created_us     INTEGER NOT NULL,
    UNIQUE (departure_id, revision)
) STRICT;
CREATE INDEX plans_network ON plans (network_id, id);
CREATE INDEX plans_charger ON plans (charger_id, id);

-- Tours: one of each number of a plan; at most one of a charger is out.
CREATE TABLE tours (
    id            TEXT    PRIMARY KEY,
    plan_id       TEXT    NOT NULL REFERENCES plans (id),
    departure_id  TEXT    NOT NULL REFERENCES departures (id),
    number        INTEGER NOT NULL,
    network_id    TEXT    NOT NULL,
    charger_id    TEXT    NOT NULL,
    state         TEXT    NOT NULL CHECK (state IN ('out', 'completed', 'overdue', 'cancelled')),
    start_us      INTEGER NOT NULL,
    finish_us     INTEGER NOT NULL,
    start_x_m     REAL    NOT NULL,
    start_y_m     REAL    NOT NULL,
    end_x_m       REAL    NOT NULL,
    end_y_m       REAL    NOT NULL,
    distance_m    REAL    NOT NULL,
    travel_j      REAL    NOT NULL,
    charge_j      REAL    NOT NULL,
    heard_us      INTEGER NOT NULL, -- the last report, or the planned finish if later
    updated_us    INTEGER NOT NULL,
    change        INTEGER NOT NULL,
    UNIQUE (plan_id, number)
) STRICT;
CREATE UNIQUE INDEX tours_out ON tours (network_id, charger_id) WHERE state = 'out';
CREATE INDEX tours_departure ON tours (departure_id, number);
CREATE INDEX tours_change ON tours (network_id, change);
CREATE INDEX tours_heard ON tours (heard_us) WHERE state = 'out';

-- The stops of the tours, in driving order.
CREATE TABLE stops (
    tour_id     TEXT    NOT NULL REFERENCES tours (id),
    position    INTEGER NOT NULL,
    request_id  TEXT    NOT NULL REFERENCES requests (id),
    sensor_id   TEXT    NOT NULL,
    x_m         REAL    NOT NULL,
    y_m         REAL    NOT NULL,
    arrive_us   INTEGER NOT NULL,
    depart_us   INTEGER NOT NULL,
    charge_j    REAL    NOT NULL,
    outcome     TEXT    CHECK (outcome IN ('charged', 'skipped', 'failed')),
    out         INTEGER NOT NULL, -- 1 while its tour is out
    PRIMARY KEY (tour_id, position)
) STRICT;
-- Planned once: no request is a stop of two tours that are out.
CREATE UNIQUE INDEX stops_out ON stops (request_id) WHERE out = 1;

-- What chargers report.
CREATE TABLE visits (
    id            TEXT    PRIMARY KEY,
    tour_id       TEXT    NOT NULL REFERENCES tours (id),
    client_id     TEXT    NOT NULL,
    fingerprint   BLOB    NOT NULL,
    sensor_id     TEXT    NOT NULL,
    outcome       TEXT    NOT NULL CHECK (outcome IN ('charged', 'skipped', 'failed')),
    arrived_us    INTEGER,
    departed_us   INTEGER,
    charge_j      REAL,
    note          TEXT,
    served        TEXT    NOT NULL, -- JSON: ids of the requests that it served
    received_us   INTEGER NOT NULL,
    UNIQUE (tour_id, client_id)
) STRICT;
