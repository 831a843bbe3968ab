-- min_compatible: 1
-- Measurement sessions and their readings. A reading is found by a number, not by a UUID in each row.

CREATE TABLE sessions (
  sequence INTEGER PRIMARY KEY,
  id TEXT NOT NULL UNIQUE,
  robot_id TEXT NOT NULL REFERENCES robots (id),
  message BLOB NOT NULL
) STRICT;

CREATE INDEX sessions_of_robot ON sessions (robot_id, sequence);

CREATE TABLE readings (
  session INTEGER NOT NULL REFERENCES sessions (sequence),
  row_index INTEGER NOT NULL CHECK (row_index >= 0),
  message BLOB NOT NULL,
  PRIMARY KEY (session, row_index)
) STRICT, WITHOUT ROWID;
