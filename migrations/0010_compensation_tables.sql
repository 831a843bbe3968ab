-- min_compatible: 10
-- The files of compensation tables, addressed by what they hold, in pieces so that no row is long. An older program
-- knows neither their jobs nor their events, so none may.

CREATE TABLE files (
  sequence INTEGER PRIMARY KEY,
  sha256 TEXT NOT NULL UNIQUE,
  size_bytes INTEGER NOT NULL
) STRICT;

CREATE TABLE file_pieces (
  file INTEGER NOT NULL REFERENCES files (sequence),
  position INTEGER NOT NULL,
  bytes BLOB NOT NULL,
  UNIQUE (file, position)
) STRICT;
