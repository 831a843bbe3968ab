-- min_compatible: 5
-- What a plant needs beside robots and sessions: its other resources, what changed with which commit, and the answers
-- to requests that carry an id. An older program would change resources without an event, so none may.

-- Instruments, tools, fixtures, targets, placements, pose sets, policies, requests, checks, robot events, reports.
CREATE TABLE resources (
  sequence INTEGER PRIMARY KEY,
  kind INTEGER NOT NULL,
  robot_id TEXT NOT NULL,
  id TEXT NOT NULL,
  deleted INTEGER NOT NULL,
  message BLOB NOT NULL,
  UNIQUE (kind, robot_id, id)
) STRICT;

CREATE INDEX resources_of_robot ON resources (robot_id, kind, sequence);
CREATE INDEX resources_of_kind ON resources (kind, sequence);

CREATE TABLE events (
  revision INTEGER NOT NULL,
  ordinal INTEGER NOT NULL,
  written_us INTEGER NOT NULL,
  kind INTEGER NOT NULL,
  robot_id TEXT NOT NULL,
  name TEXT NOT NULL,
  deleted INTEGER NOT NULL,
  message BLOB NOT NULL,
  PRIMARY KEY (revision, ordinal)
) STRICT;

CREATE INDEX events_by_age ON events (written_us);

-- Everything up to this revision is no longer in the history.
ALTER TABLE store ADD COLUMN compacted_revision INTEGER NOT NULL DEFAULT 0;
-- The history begins with this migration.
UPDATE store SET compacted_revision = revision;

CREATE TABLE replies (
  principal TEXT NOT NULL,
  method TEXT NOT NULL,
  request_id TEXT NOT NULL,
  digest TEXT NOT NULL,
  written_us INTEGER NOT NULL,
  reply BLOB NOT NULL,
  PRIMARY KEY (principal, method, request_id)
) STRICT, WITHOUT ROWID;

CREATE INDEX replies_by_age ON replies (written_us);

ALTER TABLE robots ADD COLUMN deleted INTEGER NOT NULL DEFAULT 0;
ALTER TABLE sessions ADD COLUMN deleted INTEGER NOT NULL DEFAULT 0;
