/** A plausible comparison: one task, a method with a band and one with too few seeds. */
import type { BestModels, CurveComparison, Group, Member } from '@/client/schema.gen';

const GROUPS: Group[] = [
  { key: 'her', method: 'her', variant: '', label: 'HER-Sparse', color: 1, dash: 1 },
  { key: 'her-sldr', method: 'her-sldr', variant: '', label: 'HER-Sparse+SLDR', color: 0, dash: 0 },
];

function member(seed: number, changes: Partial<Member> = {}): Member {
  return { run_id: `run-${seed}`, seed, state: 'succeeded', points: 3, x: null, y: null, ...changes };
}

export const COMPARISON: CurveComparison = {
  version: 'v1',
  metric: 'test/success_rate',
  x: 'epoch',
  statistic: 'median',
  level: 0.95,
  words: { metric: 'Test success rate', x: 'Epoch', statistic: 'median, band: quartiles (25 to 75 %)' },
  groups: GROUPS,
  panels: [
    {
      task: 'FetchPush',
      curves: [
        {
          group: 'her',
          n: 1,
          x: [1, 2, 3],
          centre: [],
          low: [],
          high: [],
          n_at: [1, 1, 1],
          has_band: false,
          losses: [],
          holds: false,
          legend: '1 seed, each by itself: too few for a band',
          members: [member(7, { x: [1, 2, 3], y: [0.1, 0.2, 0.3] })],
        },
        {
          group: 'her-sldr',
          n: 4,
          x: [1, 2, 3],
          centre: [0.2, 0.5, 0.9],
          low: [0.1, 0.4, null],
          high: [0.3, 0.6, null],
          n_at: [4, 4, 2],
          has_band: true,
          losses: [{ x: 2, y: 0.5, before: 4, after: 2 }],
          holds: false,
          legend: 'median of 2 to 4 seeds, band: quartiles (25 to 75 %)',
          members: [0, 1, 2, 3].map((seed) => member(seed)),
        },
      ],
    },
  ],
  runs: 5,
  unread: 0,
  every: 1,
  left_out: [
    { run_id: 'run-9', task: 'FetchPush', group: 'her', seed: 2, reason: 'It has not logged test/success_rate yet.' },
  ],
};

export const BEST: BestModels = {
  version: 'b1',
  statistic: 'median',
  level: 0.95,
  words: COMPARISON.words,
  groups: GROUPS,
  scores: [
    {
      task: 'FetchPush',
      group: 'her-sldr',
      n: 3,
      centre: 0.9,
      low: 0.85,
      high: 0.95,
      seeds: [0, 1, 2].map((seed) => ({
        run_id: `run-${seed}`,
        seed,
        state: 'succeeded',
        best: 0.9,
        epoch: 3,
        tests: 3,
      })),
    },
  ],
  overall: [{ group: 'her-sldr', tasks: 1, n: 3, iqm: 0.9, low: 0.85, high: 0.95 }],
  overall_tasks: ['FetchPush'],
  improvements: [
    { first: 'her-sldr', second: 'her', tasks: 1, probability: 0.98, low: 0.9, high: 1 },
    { first: 'her', second: 'her-sldr', tasks: 1, probability: 0.02, low: null, high: null },
  ],
  profiles: [
    { group: 'her-sldr', tasks: 1, n: 3, thresholds: [0, 0.5, 1], share: [1, 1, 0], low: [1, 1, 0], high: [1, 1, 0] },
  ],
  efficiency: [
    {
      task: 'FetchPush',
      group: 'her-sldr',
      threshold: 0.8,
      axis: 'env_steps',
      n: 3,
      reached: 2,
      median: 57_000,
      low: 38_000,
      high: null,
      seeds: [],
    },
  ],
  tables: [
    {
      name: 'overall',
      title: 'Best test success over all shared tasks',
      columns: [{ title: 'Method' }, { title: 'Interquartile mean' }],
      rows: [['HER-Sparse+SLDR', 0.9]],
    },
  ],
  runs: 5,
  unread: 0,
  left_out: [],
};
