-- A class as the first version of the schema kept it.
CREATE TABLE class (
    id INTEGER PRIMARY KEY,
    solo INTEGER NOT NULL,
    name TEXT NOT NULL,
    code TEXT NOT NULL,
    secret BLOB NOT NULL,
    opened_at REAL NOT NULL,
    closed_at REAL,
    door_open INTEGER NOT NULL DEFAULT 1,
    pace TEXT NOT NULL DEFAULT ''
);
CREATE TABLE member (
    id TEXT PRIMARY KEY,
    class INTEGER NOT NULL REFERENCES class (id),
    name TEXT NOT NULL,
    seed INTEGER NOT NULL,
    joined_at REAL NOT NULL,
    removed_at REAL
);
CREATE TABLE browser (
    class INTEGER NOT NULL REFERENCES class (id),
    hash TEXT NOT NULL,
    member TEXT NOT NULL REFERENCES member (id) ON DELETE CASCADE,
    instructor INTEGER NOT NULL DEFAULT 0,
    PRIMARY KEY (class, hash)
);
CREATE TABLE event (
    id INTEGER PRIMARY KEY,
    member TEXT NOT NULL REFERENCES member (id) ON DELETE CASCADE,
    at REAL NOT NULL,
    kind TEXT NOT NULL,
    lesson TEXT NOT NULL,
    step INTEGER NOT NULL,
    detail TEXT NOT NULL
);
CREATE INDEX event_of_member ON event (member);
INSERT INTO class VALUES (1, 0, 'Monday', 'K7QF2', x'00112233', 1790000000.0, NULL, 1, '');
INSERT INTO member VALUES ('a1b2c3d4e5f60718', 1, 'Ada', 4711, 1790000010.0, NULL);
INSERT INTO browser VALUES (1, 'ca978112ca1bbdcafac231b39a23dc4da786eff8147c4e72b9807785afee48bb', 'a1b2c3d4e5f60718', 0);
INSERT INTO event VALUES (1, 'a1b2c3d4e5f60718', 1790000020.0, 'opened', '02-inverse', 1, '{}');
INSERT INTO event VALUES (2, 'a1b2c3d4e5f60718', 1790000050.0, 'acted', '02-inverse', 1,
    '{"evidence": [{"title": "Step", "series": [{"label": "y", "x": [0, 1], "y": [0, 2]}]}]}');
INSERT INTO event VALUES (3, 'a1b2c3d4e5f60718', 1790000080.0, 'explained', '02-inverse', 1, '{"answer": 41.5, "right": true}');
PRAGMA application_id = 0x444C4142;
PRAGMA user_version = 1;
