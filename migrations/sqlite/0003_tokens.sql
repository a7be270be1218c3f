-- API tokens. The token itself is nowhere: it is random, so that its SHA-256 tells nothing about it. Rows are
-- never deleted: that there is one, revoked or not, is what makes the service ask for tokens.
CREATE TABLE tokens (
    id          TEXT    PRIMARY KEY,
    name        TEXT    NOT NULL,
    hash        BLOB    NOT NULL UNIQUE, -- SHA-256 of the token
    role        TEXT    NOT NULL CHECK (role IN ('base_station', 'charger', 'operator', 'admin')),
    networks    TEXT,                    -- JSON: their ids; all networks if null
    charger_id  TEXT,                    -- the charger that a token of that role is for
    created_us  INTEGER NOT NULL,
    revoked_us  INTEGER,
    CHECK ((role = 'charger') = (charger_id IS NOT NULL))
) STRICT;
-- A name is free again once its token is revoked.
CREATE UNIQUE INDEX tokens_name ON tokens (name) WHERE revoked_us IS NULL;
