-- min_compatible: 1
-- The store itself: which migrations it has, which database it is, and how many commits it has seen.

CREATE TABLE migrations (
  number INTEGER PRIMARY KEY,
  name TEXT NOT NULL,
  sha256 TEXT NOT NULL,
  min_compatible INTEGER NOT NULL,
  applied_at TEXT NOT NULL
) STRICT;

CREATE TABLE store (
  id INTEGER PRIMARY KEY CHECK (id = 1),
  epoch TEXT NOT NULL,
  revision INTEGER NOT NULL
) STRICT;
