"""The tables. `migrations/` makes them; a test holds the two equal."""

from __future__ import annotations

from typing import Any

from sqlalchemy import (
    JSON,
    BigInteger,
    Boolean,
    Column,
    Float,
    ForeignKey,
    Index,
    Integer,
    Row,
    String,
    Table,
    Text,
    UniqueConstraint,
    false,
    literal_column,
)

import backend.store.access.tables  # noqa: F401  # pyright: ignore[reportUnusedImport] - its tables are of the same metadata
from backend.store.schema import ID_LENGTH, NAME_LENGTH, UtcDateTime, metadata

SCHEMA_REVISION = "0012"
"""The migration that these tables correspond to."""

AnyRow = Row[*tuple[Any, ...]]
"""A row of whatever columns were asked for."""

TEST_METRIC_INDEX_CONDITION = "metric_values.name >= 'test/' AND metric_values.name < 'test0'"
"""Which metrics have an index by name: those of tests, few among many. A query that says so is answered from it."""


runs = Table(
    "runs",
    metadata,
    Column("number", Integer, primary_key=True, autoincrement=True),
    Column("id", String(ID_LENGTH), nullable=False, unique=True),
    Column("task", String(NAME_LENGTH), nullable=False),
    Column("phase", String(NAME_LENGTH), nullable=False),
    Column("method", String(NAME_LENGTH), nullable=False),
    Column("seed", BigInteger, nullable=False),
    Column("preset", String(NAME_LENGTH), nullable=False),
    Column("config", JSON, nullable=False),
    Column("config_hash", String(ID_LENGTH), nullable=False),
    Column("settings_hash", String(ID_LENGTH)),
    Column("state", String(ID_LENGTH), nullable=False),
    Column("reason", Text),
    Column("success_rate", Float),
    Column("attempt", Integer, nullable=False, server_default="0"),
    Column("failures", Integer, nullable=False, server_default="0"),
    Column("deaths", Integer, nullable=False, server_default="0"),
    Column("fence", Integer, nullable=False, server_default="0"),
    Column("worker_id", String(ID_LENGTH)),
    Column("lease_until", UtcDateTime),
    Column("not_before", UtcDateTime),
    Column("progress_at", UtcDateTime),
    Column("cancel_requested", Boolean, nullable=False, server_default=false()),
    Column("pause_requested", Boolean, nullable=False, server_default=false()),
    Column("gate_waived", Boolean, nullable=False, server_default=false()),
    Column("needs_gpu", Boolean, nullable=False, server_default=false()),
    Column("rank", Integer, nullable=False, server_default="0"),
    Column("queue_position", Float, nullable=False, server_default="0"),
    Column("created_at", UtcDateTime, nullable=False),
    Column("started_at", UtcDateTime),
    Column("ended_at", UtcDateTime),
    Column("deleted_at", UtcDateTime),
    Column("notes", Text),
    Column("origin", String(64)),
    Index(None, "state", "number"),
    Index(None, "state", "rank", "queue_position", "number"),
    Index(None, "queue_position"),
    Index(None, "config_hash"),
)

run_needs = Table(
    "run_needs",
    metadata,
    Column("run_id", String(ID_LENGTH), ForeignKey("runs.id"), primary_key=True),
    Column("needs_run_id", String(ID_LENGTH), ForeignKey("runs.id"), primary_key=True, index=True),
)

run_events = Table(
    "run_events",
    metadata,
    Column("id", Integer, primary_key=True, autoincrement=True),
    Column("run_id", String(ID_LENGTH), ForeignKey("runs.id"), nullable=False, index=True),
    Column("at", UtcDateTime, nullable=False),
    Column("event", String(ID_LENGTH), nullable=False),
    Column("state", String(ID_LENGTH), nullable=False),
    Column("attempt", Integer, nullable=False),
    Column("detail", Text),
)

attempts = Table(
    "attempts",
    metadata,
    Column("run_id", String(ID_LENGTH), ForeignKey("runs.id"), primary_key=True),
    Column("attempt", Integer, primary_key=True, autoincrement=False),
    Column("fence", Integer, nullable=False),
    Column("worker_id", String(ID_LENGTH), nullable=False),
    Column("host", String(NAME_LENGTH)),
    Column("started_at", UtcDateTime, nullable=False),
    Column("ended_at", UtcDateTime),
    Column("outcome", String(ID_LENGTH)),
    Column("reason", Text),
)

run_progress = Table(
    "run_progress",
    metadata,
    Column("run_id", String(ID_LENGTH), ForeignKey("runs.id"), primary_key=True),
    Column("epoch", Integer, nullable=False),
    Column("epochs", Integer, nullable=False),
    Column("env_steps", BigInteger, nullable=False),
    Column("episodes", Integer, nullable=False),
    Column("updates", Integer, nullable=False),
    Column("fraction", Float, nullable=False),
    Column("success_rate", Float),
    Column("best_success_rate", Float),
    Column("env_steps_per_s", Float),
    Column("updates_per_s", Float),
    Column("seconds_left", Float),
)

metric_steps = Table(
    "metric_steps",
    metadata,
    Column("id", Integer, primary_key=True, autoincrement=True),
    Column("run_id", String(ID_LENGTH), ForeignKey("runs.id"), nullable=False),
    Column("attempt", Integer, nullable=False),
    Column("step", Integer, nullable=False),
    Column("epoch", Integer, nullable=False),
    Column("env_steps", BigInteger, nullable=False),
    Column("episodes", Integer, nullable=False),
    Column("updates", Integer, nullable=False),
    Column("wall_seconds", Float, nullable=False),
    Index(None, "run_id", "id"),
    Index(None, "run_id", "attempt", "step"),
)

metric_values = Table(
    "metric_values",
    metadata,
    Column("step_id", Integer, ForeignKey("metric_steps.id"), primary_key=True),
    Column("name", String(NAME_LENGTH), primary_key=True),
    Column("value", Float, nullable=False),
    sqlite_with_rowid=False,
)

# A curve of tests over many runs is read from this index alone.
Index(
    "ix_metric_values_tests",
    metric_values.c.name,
    metric_values.c.step_id,
    metric_values.c.value,
    sqlite_where=literal_column(TEST_METRIC_INDEX_CONDITION.replace("metric_values.", "")),
    postgresql_where=literal_column(TEST_METRIC_INDEX_CONDITION.replace("metric_values.", "")),
)

metric_summaries = Table(
    "metric_summaries",
    metadata,
    Column("run_id", String(ID_LENGTH), ForeignKey("runs.id"), primary_key=True),
    Column("name", String(NAME_LENGTH), primary_key=True, index=True),
    Column("points", Integer, nullable=False),
    Column("last_step", Integer, nullable=False),
    Column("last", Float, nullable=False),
    Column("lowest", Float, nullable=False),
    Column("highest", Float, nullable=False),
    Column("tail", JSON, nullable=False),
)

run_tags = Table(
    "run_tags",
    metadata,
    Column("run_id", String(ID_LENGTH), ForeignKey("runs.id"), primary_key=True),
    Column("tag", String(NAME_LENGTH), primary_key=True, index=True),
)

saved_views = Table(
    "saved_views",
    metadata,
    Column("id", String(ID_LENGTH), primary_key=True),
    Column("name", String(NAME_LENGTH), nullable=False, unique=True),
    Column("search", Text, nullable=False),
    Column("created_at", UtcDateTime, nullable=False),
)

run_files = Table(
    "run_files",
    metadata,
    Column("run_id", String(ID_LENGTH), ForeignKey("runs.id"), primary_key=True),
    Column("name", String(NAME_LENGTH), primary_key=True),
    Column("kind", String(NAME_LENGTH), nullable=False),
    Column("path", Text, nullable=False),
    Column("size", BigInteger, nullable=False),
    Column("sha256", String(64), nullable=False),
    Column("attempt", Integer, nullable=False),
    Column("created_at", UtcDateTime, nullable=False),
)

episodes = Table(
    "episodes",
    metadata,
    Column("run_id", String(ID_LENGTH), ForeignKey("runs.id"), primary_key=True),
    Column("epoch", Integer, primary_key=True, autoincrement=False),
    Column("number", Integer, primary_key=True, autoincrement=False),
    Column("attempt", Integer, nullable=False),
    Column("file", String(NAME_LENGTH), nullable=False),
    Column("success", Boolean, nullable=False),
    Column("tag", String(ID_LENGTH), nullable=False),
    Column("task_return", Float, nullable=False),
    Column("worst_q", Float),
    Column("worst_q_step", Integer),
    Column("length", Integer, nullable=False),
    Column("resimulates", Boolean, nullable=False),
)

workers = Table(
    "workers",
    metadata,
    Column("id", String(ID_LENGTH), primary_key=True),
    Column("host", String(NAME_LENGTH), nullable=False),
    Column("pid", Integer, nullable=False),
    Column("executor", String(ID_LENGTH), nullable=False, server_default="local"),
    Column("slots", Integer, nullable=False),
    Column("cores", Integer, nullable=False, server_default="0"),
    Column("processor", String(NAME_LENGTH)),
    Column("gpu", String(NAME_LENGTH)),
    Column("memory_total", BigInteger, nullable=False, server_default="0"),
    Column("memory_used", BigInteger, nullable=False, server_default="0"),
    Column("draining", Boolean, nullable=False, server_default=false()),
    Column("started_at", UtcDateTime, nullable=False),
    Column("beat_at", UtcDateTime, nullable=False),
    Column("retired_at", UtcDateTime),
)

viewer_hosts = Table(
    "viewer_hosts",
    metadata,
    Column("id", String(ID_LENGTH), primary_key=True),
    Column("name", String(NAME_LENGTH)),
    Column("pid", Integer, nullable=False),
    Column("beat_at", UtcDateTime, nullable=False),
)

viewer_sessions = Table(
    "viewer_sessions",
    metadata,
    Column("id", String(ID_LENGTH), primary_key=True),
    Column("run_id", String(ID_LENGTH), ForeignKey("runs.id"), nullable=False),
    Column("request", JSON),
    Column("state", String(ID_LENGTH), nullable=False, index=True),
    Column("host_id", String(ID_LENGTH)),
    Column("port", Integer),
    Column("control_port", Integer),
    Column("message", Text),
    Column("created_at", UtcDateTime, nullable=False),
    Column("touched_at", UtcDateTime, nullable=False),
    Column("ended_at", UtcDateTime),
)

studies = Table(
    "studies",
    metadata,
    Column("number", Integer, primary_key=True, autoincrement=True),
    Column("id", String(ID_LENGTH), nullable=False, unique=True),
    Column("name", String(NAME_LENGTH), nullable=False),
    Column("note", Text, nullable=False),
    Column("preset", String(NAME_LENGTH), nullable=False),
    Column("spec", JSON, nullable=False),
    Column("created_at", UtcDateTime, nullable=False),
    Column("deleted_at", UtcDateTime),
)

study_runs = Table(
    "study_runs",
    metadata,
    Column("study_id", String(ID_LENGTH), ForeignKey("studies.id"), primary_key=True),
    Column("task", String(NAME_LENGTH), primary_key=True),
    Column("method", String(NAME_LENGTH), primary_key=True),
    Column("variant", String(NAME_LENGTH), primary_key=True),
    Column("seed", BigInteger, primary_key=True, autoincrement=False),
    Column("run_id", String(ID_LENGTH), ForeignKey("runs.id"), nullable=False, index=True),
)
"""Which run stands at which place of a study: one at most, so that no place is trained twice."""

media_jobs = Table(
    "media_jobs",
    metadata,
    Column("id", String(ID_LENGTH), primary_key=True),
    Column("run_id", String(ID_LENGTH), ForeignKey("runs.id"), nullable=False, index=True),
    Column("kind", String(ID_LENGTH), nullable=False),
    Column("source", String(64), nullable=False),
    Column("file_name", String(NAME_LENGTH), nullable=False),
    Column("arguments", JSON, nullable=False),
    Column("state", String(ID_LENGTH), nullable=False),
    Column("reason", Text),
    Column("fence", Integer, nullable=False, server_default="0"),
    Column("lease_until", UtcDateTime),
    Column("created_at", UtcDateTime, nullable=False),
    Column("ended_at", UtcDateTime),
    Index(None, "state", "created_at"),
)

webhooks = Table(
    "webhooks",
    metadata,
    Column("id", String(ID_LENGTH), primary_key=True),
    Column("url", Text, nullable=False),
    Column("secret", String(64), nullable=False),
    Column("events", JSON, nullable=False),
    Column("created_at", UtcDateTime, nullable=False),
)

webhook_deliveries = Table(
    "webhook_deliveries",
    metadata,
    Column("id", String(ID_LENGTH), primary_key=True),
    Column("webhook_id", String(ID_LENGTH), ForeignKey("webhooks.id"), nullable=False),
    Column("event", String(ID_LENGTH), nullable=False),
    Column("subject", String(ID_LENGTH), nullable=False),
    Column("occasion", String(64), nullable=False),
    Column("body", Text, nullable=False),
    Column("state", String(ID_LENGTH), nullable=False),
    Column("tries", Integer, nullable=False, server_default="0"),
    Column("not_before", UtcDateTime, nullable=False),
    Column("problem", Text),
    Column("created_at", UtcDateTime, nullable=False),
    Column("ended_at", UtcDateTime),
    UniqueConstraint("webhook_id", "event", "subject", "occasion"),
    Index(None, "state", "not_before"),
)

file_removals = Table(
    "file_removals",
    metadata,
    Column("run_id", String(ID_LENGTH), ForeignKey("runs.id"), primary_key=True),
    Column("path", Text, primary_key=True),
    Column("size", BigInteger, nullable=False),
    Column("fence", Integer, nullable=False),
    Column("marked_at", UtcDateTime, nullable=False),
)
"""Files that no row of `run_files` holds any more and whose bytes are to go."""

SHARED = "shared:"
"""Before a path in `file_removals` that lies at the place that machines share."""
