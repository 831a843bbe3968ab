-- min_compatible: 11
-- Which resources time alone may change, so that looking for those that are due reads no other; and which table has
-- which file, so that a table is found by its digest and the bytes of a deleted one can go. An older program would keep
-- neither up to date, so none may.

-- 1 = something may happen to it as time goes (is_open in server/resource/resource_type.h). What was there before counts
-- as open until it was looked at.
ALTER TABLE resources ADD COLUMN open INTEGER NOT NULL DEFAULT 0;
UPDATE resources SET open = 1 WHERE kind IN (5, 15);
CREATE INDEX resources_open ON resources (kind, open, sequence);

CREATE TABLE table_files (
  resource INTEGER PRIMARY KEY REFERENCES resources (sequence),
  sha256 TEXT NOT NULL,
  -- Microseconds of Unix time of the table's deletion; 0 = it is there; -1 = its bytes are gone.
  deleted_us INTEGER NOT NULL
) STRICT;

CREATE INDEX table_files_of_digest ON table_files (sha256, deleted_us);
CREATE INDEX table_files_by_deletion ON table_files (deleted_us) WHERE deleted_us > 0;

-- A message has its digest as 'J@' (field 9, 64 bytes) and the text itself. Tables that are deleted already keep their
-- bytes as long as those that are deleted now.
INSERT INTO table_files (resource, sha256, deleted_us)
SELECT resources.sequence, files.sha256,
  CASE resources.deleted WHEN 0 THEN 0 ELSE CAST(strftime('%s', 'now') AS INTEGER) * 1000000 END
FROM resources JOIN files ON instr(resources.message, CAST('J@' || files.sha256 AS BLOB)) > 0
WHERE resources.kind = 16;
