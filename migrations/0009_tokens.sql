-- min_compatible: 9
-- Who may call. Of a token's secret only the SHA-256 is kept. An older program would serve anybody, so none may.

CREATE TABLE tokens (
  sequence INTEGER PRIMARY KEY,
  id TEXT NOT NULL UNIQUE,
  principal TEXT NOT NULL,
  secret_sha256 TEXT NOT NULL UNIQUE,
  -- Microseconds of Unix time, written at most once an hour; 0 = never.
  last_use INTEGER NOT NULL DEFAULT 0,
  message BLOB NOT NULL
) STRICT;

CREATE INDEX tokens_of_principal ON tokens (principal, sequence);

-- The server's status counts these without reading the messages.
CREATE INDEX robots_by_deleted ON robots (deleted);
CREATE INDEX sessions_by_deleted ON sessions (deleted);
