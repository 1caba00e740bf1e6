/** Something that the session is asked for again whenever it says that there is a newer version. */
import { useEffect, useRef, useState } from 'react';
import type { SceneCommand } from '@/lib/scene-control';
import type { Scene } from '@/lib/use-scene-control';

/** @param version what the session said last; null for nothing to ask for. Answers to an earlier question are dropped. */
export function useAnswer<Answer>(scene: Scene, command: SceneCommand, version: number | null): Answer | undefined {
  const [told, setTold] = useState<{ question: string; answer: Answer }>();
  const { ask } = scene;
  const question = JSON.stringify(command);
  const now = useRef(question);
  now.current = question;
  useEffect(() => {
    if (version === null) return;
    ask<Answer>(JSON.parse(question) as SceneCommand).then(
      (answer) => {
        if (now.current === question) setTold({ question, answer });
      },
      // A connection that is lost meanwhile is renewed, and its first state asks again.
      () => undefined,
    );
  }, [ask, question, version]);
  return told?.question === question ? told.answer : undefined;
}
