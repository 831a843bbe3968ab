-- min_compatible: 8
-- When a reading came, and which readings came from which client's spool.

-- Microseconds of Unix time; 0: stored before this was kept.
ALTER TABLE readings ADD COLUMN server_time INTEGER NOT NULL DEFAULT 0;

-- A run: readings of one source whose sequences and rows both follow one another. It grows in place, so that an
-- append costs one small update however long the source is.
CREATE TABLE reading_runs (
  source TEXT NOT NULL,
  first_sequence INTEGER NOT NULL CHECK (first_sequence > 0),
  session INTEGER NOT NULL REFERENCES sessions (sequence),
  first_row INTEGER NOT NULL CHECK (first_row >= 0),
  count INTEGER NOT NULL CHECK (count > 0),
  PRIMARY KEY (source, first_sequence)
) STRICT, WITHOUT ROWID;
