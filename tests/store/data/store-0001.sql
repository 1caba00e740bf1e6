BEGIN TRANSACTION;
CREATE TABLE alembic_version (
	version_num VARCHAR(32) NOT NULL, 
	CONSTRAINT alembic_version_pkc PRIMARY KEY (version_num)
);
INSERT INTO "alembic_version" VALUES('0001');
CREATE TABLE attempts (
	run_id VARCHAR(32) NOT NULL, 
	attempt INTEGER NOT NULL, 
	fence INTEGER NOT NULL, 
	worker_id VARCHAR(32) NOT NULL, 
	started_at DATETIME NOT NULL, 
	ended_at DATETIME, 
	outcome VARCHAR(32), 
	reason TEXT, 
	CONSTRAINT pk_attempts PRIMARY KEY (run_id, attempt), 
	CONSTRAINT fk_attempts_run_id FOREIGN KEY(run_id) REFERENCES runs (id)
);
INSERT INTO "attempts" VALUES('21430b7b6a02',1,1,'f3d036893edd','2026-11-22 21:36:11.677819','2026-11-22 21:36:11.723320','succeeded',NULL);
INSERT INTO "attempts" VALUES('785f0b5c6a60',1,1,'f3d036893edd','2026-11-22 21:36:11.749766',NULL,NULL,NULL);
CREATE TABLE metric_steps (
	id INTEGER NOT NULL, 
	run_id VARCHAR(32) NOT NULL, 
	attempt INTEGER NOT NULL, 
	step INTEGER NOT NULL, 
	epoch INTEGER NOT NULL, 
	env_steps BIGINT NOT NULL, 
	episodes INTEGER NOT NULL, 
	updates INTEGER NOT NULL, 
	wall_seconds FLOAT NOT NULL, 
	CONSTRAINT pk_metric_steps PRIMARY KEY (id), 
	CONSTRAINT fk_metric_steps_run_id FOREIGN KEY(run_id) REFERENCES runs (id)
);
INSERT INTO "metric_steps" VALUES(1,'21430b7b6a02',1,1,1,200,4,4,0.5);
INSERT INTO "metric_steps" VALUES(2,'21430b7b6a02',1,2,1,400,8,8,1.0);
INSERT INTO "metric_steps" VALUES(3,'785f0b5c6a60',1,1,1,200,4,4,0.5);
INSERT INTO "metric_steps" VALUES(4,'785f0b5c6a60',1,2,1,400,8,8,1.0);
INSERT INTO "metric_steps" VALUES(5,'785f0b5c6a60',1,3,1,600,12,12,1.5);
CREATE TABLE metric_values (
	step_id INTEGER NOT NULL, 
	name VARCHAR(200) NOT NULL, 
	value FLOAT NOT NULL, 
	CONSTRAINT pk_metric_values PRIMARY KEY (step_id, name), 
	CONSTRAINT fk_metric_values_step_id FOREIGN KEY(step_id) REFERENCES metric_steps (id)
)
 WITHOUT ROWID

;
INSERT INTO "metric_values" VALUES(1,'test/success_rate',0.1);
INSERT INTO "metric_values" VALUES(2,'test/success_rate',0.2);
INSERT INTO "metric_values" VALUES(3,'test/success_rate',0.1);
INSERT INTO "metric_values" VALUES(4,'test/success_rate',0.2);
INSERT INTO "metric_values" VALUES(5,'test/success_rate',0.3);
CREATE TABLE run_events (
	id INTEGER NOT NULL, 
	run_id VARCHAR(32) NOT NULL, 
	at DATETIME NOT NULL, 
	event VARCHAR(32) NOT NULL, 
	state VARCHAR(32) NOT NULL, 
	attempt INTEGER NOT NULL, 
	detail TEXT, 
	CONSTRAINT pk_run_events PRIMARY KEY (id), 
	CONSTRAINT fk_run_events_run_id FOREIGN KEY(run_id) REFERENCES runs (id)
);
INSERT INTO "run_events" VALUES(1,'21430b7b6a02','2026-11-22 21:36:11.637949','created','queued',0,NULL);
INSERT INTO "run_events" VALUES(2,'2e5f05d7f2cf','2026-11-22 21:36:11.637949','created','blocked',0,'Waits for the locomotion run 21430b7b6a02.');
INSERT INTO "run_events" VALUES(3,'785f0b5c6a60','2026-11-22 21:36:11.666221','created','queued',0,NULL);
INSERT INTO "run_events" VALUES(4,'f6684b5925c5','2026-11-22 21:36:11.666221','created','queued',0,NULL);
INSERT INTO "run_events" VALUES(5,'2105dd03018f','2026-11-22 21:36:11.675450','created','queued',0,NULL);
INSERT INTO "run_events" VALUES(6,'21430b7b6a02','2026-11-22 21:36:11.677819','claimed','running',1,NULL);
INSERT INTO "run_events" VALUES(7,'21430b7b6a02','2026-11-22 21:36:11.723320','succeeded','succeeded',1,NULL);
INSERT INTO "run_events" VALUES(8,'2e5f05d7f2cf','2026-11-22 21:36:11.723320','held','blocked',0,'Its locomotion run 21430b7b6a02 reached 50.0% test success, below the gate of 95.0%; choose a longer preset, or lower sldr.gate, and launch again.');
INSERT INTO "run_events" VALUES(9,'785f0b5c6a60','2026-11-22 21:36:11.749766','claimed','running',1,NULL);
CREATE TABLE run_files (
	run_id VARCHAR(32) NOT NULL, 
	name VARCHAR(200) NOT NULL, 
	kind VARCHAR(200) NOT NULL, 
	path TEXT NOT NULL, 
	size BIGINT NOT NULL, 
	sha256 VARCHAR(64) NOT NULL, 
	attempt INTEGER NOT NULL, 
	created_at DATETIME NOT NULL, 
	CONSTRAINT pk_run_files PRIMARY KEY (run_id, name), 
	CONSTRAINT fk_run_files_run_id FOREIGN KEY(run_id) REFERENCES runs (id)
);
INSERT INTO "run_files" VALUES('21430b7b6a02','locomotion.pt','locomotion','runs/21430b7b6a02/locomotion.pt',3,'0000000000000000000000000000000000000000000000000000000000000000',1,'2026-11-22 21:36:11.718651');
CREATE TABLE run_needs (
	run_id VARCHAR(32) NOT NULL, 
	needs_run_id VARCHAR(32) NOT NULL, 
	CONSTRAINT pk_run_needs PRIMARY KEY (run_id, needs_run_id), 
	CONSTRAINT fk_run_needs_needs_run_id FOREIGN KEY(needs_run_id) REFERENCES runs (id), 
	CONSTRAINT fk_run_needs_run_id FOREIGN KEY(run_id) REFERENCES runs (id)
);
INSERT INTO "run_needs" VALUES('2e5f05d7f2cf','21430b7b6a02');
CREATE TABLE run_progress (
	run_id VARCHAR(32) NOT NULL, 
	epoch INTEGER NOT NULL, 
	epochs INTEGER NOT NULL, 
	env_steps BIGINT NOT NULL, 
	episodes INTEGER NOT NULL, 
	updates INTEGER NOT NULL, 
	fraction FLOAT NOT NULL, 
	success_rate FLOAT, 
	best_success_rate FLOAT, 
	env_steps_per_s FLOAT, 
	updates_per_s FLOAT, 
	seconds_left FLOAT, 
	CONSTRAINT pk_run_progress PRIMARY KEY (run_id), 
	CONSTRAINT fk_run_progress_run_id FOREIGN KEY(run_id) REFERENCES runs (id)
);
INSERT INTO "run_progress" VALUES('785f0b5c6a60',1,2,600,12,12,0.75,0.3,0.3,10.0,10.0,5.0);
CREATE TABLE runs (
	number INTEGER NOT NULL, 
	id VARCHAR(32) NOT NULL, 
	task VARCHAR(200) NOT NULL, 
	phase VARCHAR(200) NOT NULL, 
	method VARCHAR(200) NOT NULL, 
	seed BIGINT NOT NULL, 
	preset VARCHAR(200) NOT NULL, 
	config JSON NOT NULL, 
	config_hash VARCHAR(32) NOT NULL, 
	state VARCHAR(32) NOT NULL, 
	reason TEXT, 
	success_rate FLOAT, 
	attempt INTEGER DEFAULT '0' NOT NULL, 
	failures INTEGER DEFAULT '0' NOT NULL, 
	fence INTEGER DEFAULT '0' NOT NULL, 
	worker_id VARCHAR(32), 
	lease_until DATETIME, 
	not_before DATETIME, 
	progress_at DATETIME, 
	cancel_requested BOOLEAN DEFAULT 0 NOT NULL, 
	pause_requested BOOLEAN DEFAULT 0 NOT NULL, 
	created_at DATETIME NOT NULL, 
	started_at DATETIME, 
	ended_at DATETIME, 
	CONSTRAINT pk_runs PRIMARY KEY (number), 
	CONSTRAINT uq_runs_id UNIQUE (id)
);
INSERT INTO "runs" VALUES(1,'21430b7b6a02','FetchPush','locomotion','her',0,'smoke','{"task": "FetchPush", "phase": "locomotion", "method": "her", "seed": 0, "loop": {"epochs": 2, "cycles_per_epoch": 2, "episodes_per_cycle": 4, "updates_per_cycle": 4, "updates_per_sync": 4, "batch_size": 64, "warmup_cycles": 1, "test_episodes": 4, "stop_at_success": 1.0, "stop_after_tests": 0}, "agent": {"hidden_sizes": [32, 32, 32], "learning_rate": 0.001, "gamma": 0.98, "target_rate": 0.05, "action_l2": 1.0}, "exploration": {"random_action_probability": 0.2, "noise_std": 0.05}, "replay": {"capacity": 2000, "relabel_probability": 0.8, "still_weight": 1.0}, "sldr": {"reward": "advantage", "weight": 1.0, "gate": 0.95}, "scene": {"variant": "ours", "locomotion_robot": "auto"}, "compute": {"device": "auto", "precision": "float32", "threads": 1}}','7acdd05967cc6231','succeeded',NULL,0.5,1,0,1,NULL,NULL,NULL,'2026-11-22 21:36:11.717079',0,0,'2026-11-22 21:36:11.637949','2026-11-22 21:36:11.677819','2026-11-22 21:36:11.723320');
INSERT INTO "runs" VALUES(2,'2e5f05d7f2cf','FetchPush','manipulation','her-sldr',0,'smoke','{"task": "FetchPush", "phase": "manipulation", "method": "her-sldr", "seed": 0, "loop": {"epochs": 2, "cycles_per_epoch": 2, "episodes_per_cycle": 4, "updates_per_cycle": 4, "updates_per_sync": 4, "batch_size": 64, "warmup_cycles": 1, "test_episodes": 4, "stop_at_success": 1.0, "stop_after_tests": 0}, "agent": {"hidden_sizes": [32, 32, 32], "learning_rate": 0.001, "gamma": 0.98, "target_rate": 0.05, "action_l2": 1.0}, "exploration": {"random_action_probability": 0.3, "noise_std": 0.2}, "replay": {"capacity": 2000, "relabel_probability": 0.8, "still_weight": 1.0}, "sldr": {"reward": "advantage", "weight": 1.0, "gate": 0.95}, "scene": {"variant": "ours", "locomotion_robot": "auto"}, "compute": {"device": "auto", "precision": "float32", "threads": 1}}','c4a8ade67ade65ca','blocked','Its locomotion run 21430b7b6a02 reached 50.0% test success, below the gate of 95.0%; choose a longer preset, or lower sldr.gate, and launch again.',NULL,0,0,0,NULL,NULL,NULL,NULL,0,0,'2026-11-22 21:36:11.637949',NULL,NULL);
INSERT INTO "runs" VALUES(3,'785f0b5c6a60','FetchPush','manipulation','her',0,'smoke','{"task": "FetchPush", "phase": "manipulation", "method": "her", "seed": 0, "loop": {"epochs": 2, "cycles_per_epoch": 2, "episodes_per_cycle": 4, "updates_per_cycle": 4, "updates_per_sync": 4, "batch_size": 64, "warmup_cycles": 1, "test_episodes": 4, "stop_at_success": 1.0, "stop_after_tests": 0}, "agent": {"hidden_sizes": [32, 32, 32], "learning_rate": 0.001, "gamma": 0.98, "target_rate": 0.05, "action_l2": 1.0}, "exploration": {"random_action_probability": 0.3, "noise_std": 0.2}, "replay": {"capacity": 2000, "relabel_probability": 0.8, "still_weight": 1.0}, "sldr": {"reward": "advantage", "weight": 1.0, "gate": 0.0}, "scene": {"variant": "ours", "locomotion_robot": "auto"}, "compute": {"device": "auto", "precision": "float32", "threads": 1}}','2130ebe5f33e1acf','running',NULL,NULL,1,0,1,'f3d036893edd','2026-11-22 21:37:11.749766',NULL,'2026-11-22 21:36:11.766137',0,0,'2026-11-22 21:36:11.666221','2026-11-22 21:36:11.749766',NULL);
INSERT INTO "runs" VALUES(4,'f6684b5925c5','FetchPush','manipulation','her',1,'smoke','{"task": "FetchPush", "phase": "manipulation", "method": "her", "seed": 1, "loop": {"epochs": 2, "cycles_per_epoch": 2, "episodes_per_cycle": 4, "updates_per_cycle": 4, "updates_per_sync": 4, "batch_size": 64, "warmup_cycles": 1, "test_episodes": 4, "stop_at_success": 1.0, "stop_after_tests": 0}, "agent": {"hidden_sizes": [32, 32, 32], "learning_rate": 0.001, "gamma": 0.98, "target_rate": 0.05, "action_l2": 1.0}, "exploration": {"random_action_probability": 0.3, "noise_std": 0.2}, "replay": {"capacity": 2000, "relabel_probability": 0.8, "still_weight": 1.0}, "sldr": {"reward": "advantage", "weight": 1.0, "gate": 0.0}, "scene": {"variant": "ours", "locomotion_robot": "auto"}, "compute": {"device": "auto", "precision": "float32", "threads": 1}}','8639267aa7a44752','queued',NULL,NULL,0,0,0,NULL,NULL,NULL,NULL,0,0,'2026-11-22 21:36:11.666221',NULL,NULL);
INSERT INTO "runs" VALUES(5,'2105dd03018f','FetchPush','manipulation','ddpg',0,'smoke','{"task": "FetchPush", "phase": "manipulation", "method": "ddpg", "seed": 0, "loop": {"epochs": 2, "cycles_per_epoch": 2, "episodes_per_cycle": 4, "updates_per_cycle": 4, "updates_per_sync": 4, "batch_size": 64, "warmup_cycles": 1, "test_episodes": 4, "stop_at_success": 1.0, "stop_after_tests": 0}, "agent": {"hidden_sizes": [32, 32, 32], "learning_rate": 0.001, "gamma": 0.98, "target_rate": 0.05, "action_l2": 1.0}, "exploration": {"random_action_probability": 0.3, "noise_std": 0.2}, "replay": {"capacity": 2000, "relabel_probability": 0.0, "still_weight": 1.0}, "sldr": {"reward": "advantage", "weight": 1.0, "gate": 0.0}, "scene": {"variant": "ours", "locomotion_robot": "auto"}, "compute": {"device": "cuda", "precision": "float32", "threads": 1}}','928457c9b6595777','queued',NULL,NULL,0,0,0,NULL,NULL,NULL,NULL,0,0,'2026-11-22 21:36:11.675450',NULL,NULL);
CREATE TABLE viewer_hosts (
	id VARCHAR(32) NOT NULL, 
	pid INTEGER NOT NULL, 
	beat_at DATETIME NOT NULL, 
	CONSTRAINT pk_viewer_hosts PRIMARY KEY (id)
);
INSERT INTO "viewer_hosts" VALUES('here-7',7,'2026-11-22 21:36:11.635340');
CREATE TABLE viewer_sessions (
	id VARCHAR(32) NOT NULL, 
	run_id VARCHAR(32) NOT NULL, 
	state VARCHAR(32) NOT NULL, 
	host_id VARCHAR(32), 
	port INTEGER, 
	message TEXT, 
	created_at DATETIME NOT NULL, 
	touched_at DATETIME NOT NULL, 
	ended_at DATETIME, 
	CONSTRAINT pk_viewer_sessions PRIMARY KEY (id), 
	CONSTRAINT fk_viewer_sessions_run_id FOREIGN KEY(run_id) REFERENCES runs (id)
);
CREATE TABLE workers (
	id VARCHAR(32) NOT NULL, 
	host VARCHAR(200) NOT NULL, 
	pid INTEGER NOT NULL, 
	slots INTEGER NOT NULL, 
	started_at DATETIME NOT NULL, 
	beat_at DATETIME NOT NULL, 
	retired_at DATETIME, 
	CONSTRAINT pk_workers PRIMARY KEY (id)
);
INSERT INTO "workers" VALUES('f3d036893edd','here',123,1,'2026-11-22 21:36:11.633247','2026-11-22 21:36:11.633247',NULL);
CREATE INDEX ix_runs_config_hash ON runs (config_hash);
CREATE INDEX ix_runs_state_number ON runs (state, number);
CREATE INDEX ix_metric_steps_run_id_attempt_step ON metric_steps (run_id, attempt, step);
CREATE INDEX ix_metric_steps_run_id_id ON metric_steps (run_id, id);
CREATE INDEX ix_run_events_run_id ON run_events (run_id);
CREATE INDEX ix_run_needs_needs_run_id ON run_needs (needs_run_id);
CREATE INDEX ix_viewer_sessions_state ON viewer_sessions (state);
COMMIT;
