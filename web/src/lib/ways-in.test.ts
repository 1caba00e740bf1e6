import { expect, test } from 'vitest';
import type { Launch, StudySpec } from '@/client/schema.gen';
import launch from '@/testing/ways-in/launch.json';
import launchCommandText from '@/testing/ways-in/launch-command.txt?raw';
import launchScriptText from '@/testing/ways-in/launch-script.txt?raw';
import study from '@/testing/ways-in/study.json';
import studyCommandText from '@/testing/ways-in/study-command.txt?raw';
import studyScriptText from '@/testing/ways-in/study-script.txt?raw';
import { launchCommand, launchScript, studyCommand, studyScript } from './ways-in';

const SERVER = 'http://127.0.0.1:8000';

// tests/api/test_ways_in.py runs the very texts and looks at what they have launched.
test('a launch as command and script', () => {
  expect(launchCommand(launch as Launch, SERVER)).toBe(launchCommandText);
  expect(launchScript(launch as Launch, SERVER)).toBe(launchScriptText);
});

test('a study as command and script', () => {
  expect(studyCommand(study.name, study.spec as StudySpec, SERVER)).toBe(studyCommandText);
  expect(studyScript(study.name, study.spec as StudySpec, SERVER)).toBe(studyScriptText);
});

test('a launch of the object, with words that mean something in JSON', () => {
  const odd = {
    ...(launch as Launch),
    phase: 'locomotion',
    seeds: [3],
    overrides: { a: { b: 'true', c: null } },
  } as const;
  expect(launchCommand(odd as unknown as Launch, SERVER)).toContain('--phase locomotion');
  expect(launchCommand(odd as unknown as Launch, SERVER)).toContain(`--seeds 3 \\\n`);
  expect(launchCommand(odd as unknown as Launch, SERVER)).toContain(`--set 'a.b="true"' \\\n  --set a.c=null`);
  expect(launchScript(odd as unknown as Launch, SERVER)).toContain('settings={"a": {"b": "true", "c": None}},');
});
