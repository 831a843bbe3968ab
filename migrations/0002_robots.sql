-- min_compatible: 1
-- Robots and their immutable nominal revisions, numbered from 1 per robot.

CREATE TABLE robots (
  id TEXT PRIMARY KEY,
  message BLOB NOT NULL
) STRICT;

CREATE TABLE nominals (
  robot_id TEXT NOT NULL REFERENCES robots (id),
  number INTEGER NOT NULL CHECK (number > 0),
  digest TEXT NOT NULL,
  message BLOB NOT NULL,
  PRIMARY KEY (robot_id, number)
) STRICT;
