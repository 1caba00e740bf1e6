/** The control of a 3D view that is open, with its newest state. */
import { useCallback, useEffect, useState, useSyncExternalStore } from 'react';
import { type SceneCommand, SceneControl, type SceneState } from '@/lib/scene-control';

const NOTHING = (): (() => void) => () => undefined;
const UNKNOWN = (): undefined => undefined;

export interface Scene {
  /** What the view told last; undefined until it has. */
  readonly state: SceneState | undefined;
  /** Ask for something and wait for what comes of it. */
  readonly ask: <Answer>(command: SceneCommand) => Promise<Answer>;
  /** Ask for something; why it was refused, if it was, is in `problem`. */
  readonly tell: (command: SceneCommand) => void;
  readonly problem: string | undefined;
}

export function useSceneControl(url: string): Scene {
  const [control, setControl] = useState<SceneControl>();
  const [problem, setProblem] = useState<string>();
  useEffect(() => {
    const made = new SceneControl(url);
    setControl(made);
    return () => made.close();
  }, [url]);
  const state = useSyncExternalStore(control?.subscribe ?? NOTHING, control?.read ?? UNKNOWN);
  const ask = useCallback(
    <Answer>(command: SceneCommand): Promise<Answer> =>
      control ? control.ask(command) : Promise.reject(new Error('The 3D view is not connected yet.')),
    [control],
  );
  const tell = useCallback(
    (command: SceneCommand): void => {
      ask(command).then(
        () => setProblem(undefined),
        (error: Error) => setProblem(error.message),
      );
    },
    [ask],
  );
  return { state, ask, tell, problem };
}
