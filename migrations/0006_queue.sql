-- min_compatible: 1
-- The queue of jobs by priority and deadline, and results found by their content.

ALTER TABLE jobs ADD COLUMN priority INTEGER NOT NULL DEFAULT 0;
-- Microseconds since 1970-01-01 UTC; 0 = none.
ALTER TABLE jobs ADD COLUMN deadline INTEGER NOT NULL DEFAULT 0;

-- Who is next: state, then priority (-100 to 100, higher first), then the order of creation.
CREATE INDEX jobs_queue ON jobs (state, priority DESC, sequence, robot_id);
CREATE INDEX jobs_by_deadline ON jobs (state, deadline);

-- Digest of the result and of its job's input; '' for those from before this column.
ALTER TABLE calibrations ADD COLUMN digest TEXT NOT NULL DEFAULT '';
ALTER TABLE calibrations ADD COLUMN input_digest TEXT NOT NULL DEFAULT '';

CREATE INDEX calibrations_by_content ON calibrations (robot_id, digest, input_digest);
