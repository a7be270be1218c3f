-- Explanations of plans, made after them and apart, so that no tour waits for its explanation. A plan without a
-- row here, which is every plan of a database that was made before, is one that nobody has tried to explain.
CREATE TABLE explanations (
    plan_id     TEXT    PRIMARY KEY REFERENCES plans (id),
    attempts    INTEGER NOT NULL, -- counted before each begins: one that kills the process counts too
    document    BLOB,             -- JSON, compressed with zstd; null until there is one
    updated_us  INTEGER NOT NULL
) STRICT;
