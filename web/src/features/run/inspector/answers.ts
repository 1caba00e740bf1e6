/** What the inspector's session tells. */
import type { HeatAxis, Rgb } from '@/lib/heat-map';
import type { SceneState } from '@/lib/scene-control';

/** What can be chosen. */
export interface About {
  readonly task: string;
  readonly start_tasks: readonly string[];
  /** The objects that act side by side. */
  readonly objects: readonly string[];
  /** Bodies of each object that are pulled. */
  readonly bodies: number;
  readonly shapes: readonly string[];
  readonly spaces: readonly { readonly name: string; readonly title: string }[];
  readonly slices: readonly SliceKind[];
  readonly can_place: boolean;
  readonly block: number;
  readonly most: number;
  readonly success_rate: number;
  readonly test_episodes: number;
  readonly scale: readonly Rgb[];
}

export interface SliceKind {
  readonly kind: string;
  readonly title: string;
  /** Names of the two axes of each plane. */
  readonly planes: readonly (readonly [string, string])[];
}

/** How a fan of demonstrations stands. */
export interface FanState {
  readonly seed: number;
  readonly done: number;
  readonly count: number;
  readonly collecting: boolean;
  readonly version: number;
  readonly successes: number | null;
  readonly low: number | null;
  readonly high: number | null;
  readonly median_s: number | null;
}

export const LOOKS = ['path', 'fan', 'arrows', 'surface', 'grips'] as const;
export type Look = (typeof LOOKS)[number];

export interface InspectorState extends SceneState {
  /** The task whose starts and goals are drawn. */
  readonly starts: string;
  readonly seed: number;
  readonly number: number;
  readonly origin: 'drawn' | 'replayed' | 'placed';
  readonly exact: boolean | null;
  readonly timeline: number;
  readonly reached: boolean;
  readonly looks: Readonly<Record<Look, boolean>>;
  readonly slice: {
    readonly version: number;
    readonly kind: string;
    readonly plane: number;
    readonly body: number;
    readonly part: number;
  };
  readonly fan: FanState | null;
}

/** Success and time to goal over a space, cells by layer, row and column. */
export interface CoverageAnswer {
  readonly space: string;
  readonly title: string;
  readonly x: HeatAxis;
  readonly y: HeatAxis;
  readonly layer: HeatAxis;
  readonly episodes: readonly (readonly (readonly number[])[])[];
  readonly successes: readonly (readonly (readonly number[])[])[];
  readonly median_s: readonly (readonly (readonly (number | null)[])[])[];
}

export interface Failure {
  readonly number: number;
  readonly object: string;
  readonly ending: 'missed' | 'left';
  readonly gaps: Readonly<Record<string, number>>;
}

export interface FailuresAnswer {
  readonly total: number;
  readonly failures: readonly Failure[];
}

/** A slice of Q: `value` has a row for each value up. */
export interface SliceAnswer {
  readonly kind: string;
  readonly title: string;
  readonly axes: readonly [string, string];
  readonly unit: string;
  readonly across: readonly number[];
  readonly up: readonly number[];
  readonly value: readonly (readonly number[])[];
  readonly here: readonly [number, number];
  readonly now: number;
}
