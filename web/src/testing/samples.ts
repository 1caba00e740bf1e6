/** Plausible answers of the server. */
import type { Choices, RunDetail, RunSummary, StudyDetail, StudyPreview, StudyTemplate } from '@/client/schema.gen';

export const DEFAULTS = {
  task: 'FetchPush',
  loop: { epochs: 20, batch_size: 1024 },
  agent: { hidden_sizes: [256, 256], gamma: 0.98 },
  compute: { device: 'auto' },
};

/** A small config schema of the same kind as the real one. */
export const CONFIG_SCHEMA = {
  type: 'object',
  $defs: {
    LoopConfig: {
      description: 'How much is collected.',
      properties: {
        epochs: { type: 'integer', exclusiveMinimum: 0, description: 'Epochs of training.' },
        batch_size: { type: 'integer', exclusiveMinimum: 0, description: 'Transitions in each update.' },
      },
    },
    AgentConfig: {
      properties: {
        hidden_sizes: { type: 'array', items: { type: 'integer', exclusiveMinimum: 0 } },
        gamma: { type: 'number', exclusiveMinimum: 0, exclusiveMaximum: 1 },
      },
    },
    ComputeConfig: { properties: { device: { type: 'string', enum: ['auto', 'cpu', 'cuda'] } } },
  },
  properties: {
    task: { type: 'string' },
    loop: { $ref: '#/$defs/LoopConfig' },
    agent: { $ref: '#/$defs/AgentConfig' },
    compute: { $ref: '#/$defs/ComputeConfig' },
  },
};

export const CHOICES: Choices = {
  tasks: [
    {
      name: 'FetchPush',
      goal_text: 'Push the block to the target.',
      obs_size: 25,
      goal_size: 3,
      robot_action_size: 4,
      object_action_size: 7,
      episode_length: 50,
      success_distance: 0.05,
      success_angle: null,
      picture_url: '/api/tasks/FetchPush/picture',
    },
  ],
  phases: ['locomotion', 'manipulation'],
  methods: [
    {
      name: 'her',
      title: 'HER-Sparse',
      summary: 'Hindsight.',
      needs_locomotion: false,
      phases: ['locomotion', 'manipulation'],
    },
    {
      name: 'her-dense',
      title: 'HER-Dense',
      summary: 'Distances.',
      needs_locomotion: false,
      phases: ['manipulation'],
    },
    {
      name: 'her-sldr',
      title: 'HER-Sparse+SLDR',
      summary: 'Hindsight and SLDR.',
      needs_locomotion: true,
      phases: ['manipulation'],
    },
  ],
  presets: [
    { name: 'paper', summary: 'As in the paper.' },
    { name: 'quick', summary: 'Minutes.' },
  ],
  config_schema: CONFIG_SCHEMA,
};

export const RUN: RunSummary = {
  id: 'run-1',
  task: 'FetchPush',
  phase: 'manipulation',
  method: 'her-sldr',
  seed: 0,
  preset: 'quick',
  state: 'running',
  reason: null,
  needs: [],
  attempt: 1,
  progress: {
    epoch: 3,
    epochs: 20,
    env_steps: 57_000,
    episodes: 1140,
    updates: 3600,
    fraction: 0.15,
    success_rate: 0.42,
    best_success_rate: 0.5,
    env_steps_per_s: 3123,
    updates_per_s: 88.2,
    seconds_left: 200,
  },
  created_at: '2026-01-01T10:00:00Z',
  started_at: '2026-01-01T10:00:05Z',
  ended_at: null,
  trained_s: 0,
  training_since: '2026-01-01T10:00:05Z',
  cancel_requested: false,
  pause_requested: false,
  is_below_gate: false,
  gate_waived: false,
  priority: 0,
  deleted_at: null,
  settings_hash: 'fedcba9876543210',
  changes: [],
  tags: [],
};

export const DETAIL: RunDetail = {
  ...RUN,
  config: { ...DEFAULTS, agent: { ...DEFAULTS.agent, gamma: 0.99 } },
  config_hash: '0123456789abcdef',
  notes: '',
  locomotion_run_id: null,
  has_policy: false,
  has_recording: false,
};

export const TEMPLATE: StudyTemplate = {
  name: 'two-minutes',
  title: 'Two minutes of FetchPush',
  summary: 'See what a study shows.',
  spec: {
    tasks: ['FetchPush'],
    methods: ['her', 'her-sldr'],
    seeds: [0, 1, 2],
    preset: 'quick',
    overrides: { loop: { epochs: 5 } },
    variants: [],
    locomotion: 'zoo',
  },
};

const STUDY_RUN = { task: 'FetchPush', state: 'succeeded' as const, reason: null, progress: 1, best_success_rate: 0.9 };
const CELL = { task: 'FetchPush', variant: '', progress: 1, tested: 1, missing_seeds: [] };

/** A study of which one method is done, and the other misses a seed and has a failed run. */
export const STUDY: StudyDetail = {
  id: 'study-1',
  name: 'Push',
  note: 'What it is for.',
  spec: { ...TEMPLATE.spec, seeds: [0, 1], overrides: {} },
  created_at: '2026-01-01T10:00:00Z',
  deleted_at: null,
  size: 4,
  states: { succeeded: 2, failed: 1 },
  progress: 0.6,
  cells: [
    {
      ...CELL,
      method: 'her',
      runs: [
        { ...STUDY_RUN, run_id: 'run-1', seed: 0 },
        { ...STUDY_RUN, run_id: 'run-2', seed: 1, best_success_rate: 0.7 },
      ],
      states: { succeeded: 2 },
      tested: 2,
      best_success_rate: 0.8,
    },
    {
      ...CELL,
      method: 'her-sldr',
      runs: [
        { ...STUDY_RUN, run_id: 'run-3', seed: 0, state: 'failed', reason: 'The loss became NaN.', progress: 0.4 },
      ],
      states: { failed: 1 },
      progress: 0.2,
      best_success_rate: 0.42,
      missing_seeds: [1],
    },
  ],
  locomotion: [{ ...STUDY_RUN, run_id: 'run-0', seed: 0 }],
};

export const PREVIEW: StudyPreview = {
  places: [
    { task: 'FetchPush', method: 'her', variant: '', seed: 0, standing: 'joined', run_id: 'run-1' },
    { task: 'FetchPush', method: 'her', variant: '', seed: 1, standing: 'new', run_id: null },
    { task: 'FetchPush', method: 'her-sldr', variant: '', seed: 0, standing: 'new', run_id: null },
    { task: 'FetchPush', method: 'her-sldr', variant: '', seed: 1, standing: 'new', run_id: null },
  ],
  locomotion: [{ task: 'FetchPush', run_id: null, zoo_success: null }],
  queued: 4,
  estimate: {
    training_s: 4000,
    until_done_s: 2000,
    unknown_runs: 0,
    slots: 2,
    disk_bytes: 2e9,
    disk_free_bytes: 5e10,
  },
};
