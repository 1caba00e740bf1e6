/** What the kinds of 3D views tell besides the transport. */
import type { SceneState } from '@/lib/scene-control';

export type GhostMode = 'off' | 'step' | 'whole';

/** The state of a view of a run; what its kind has not got is missing. */
export interface RunSceneState extends SceneState {
  /** Whether each episode shown has met its goal at this step. */
  readonly reached?: readonly boolean[];
  readonly ghost?: { readonly mode: GhostMode; readonly from: number; readonly parts: readonly string[] };
  readonly arrows?: { readonly on: boolean; readonly turns: boolean };
  /** Whether the goal can be dragged. */
  readonly gizmo?: boolean;
  readonly policies?: readonly {
    readonly name: string;
    readonly epoch: number | null;
    readonly problem: string | null;
  }[];
  /** Of the time machine: the epochs of its policies, and which is shown. */
  readonly epochs?: readonly (number | null)[];
  readonly at?: number;
  /** Whether each policy met the goal at the end; null until it is there. */
  readonly successes?: readonly (boolean | null)[];
}
