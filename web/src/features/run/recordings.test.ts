import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import type { RunFile } from '@/client/schema.gen';
import { newestRecording, openCommand, RERUN_VERSION, versionUrl } from './recordings';

function file(name: string, created_at: string, sha256 = 'a'.repeat(64)): RunFile {
  return {
    name,
    created_at,
    sha256,
    kind: 'recording',
    size: 1,
    ticket: 'ticket',
    url: `/api/runs/run-1/files/${name}`,
  };
}

test('the recording that was written last is opened, whatever its name', () => {
  const files = [
    file('recording-attempt-10.rrd', '2026-01-01T12:00:00Z'),
    file('recording-attempt-9.rrd', '2026-01-01T11:00:00Z'),
    file('policy-best.pt', '2026-01-01T13:00:00Z'),
  ];
  expect(newestRecording(files)?.name).toBe('recording-attempt-10.rrd');
  expect(newestRecording([])).toBeUndefined();
  expect(newestRecording(undefined)).toBeUndefined();
});

test('a renewed recording has another address', () => {
  const [one, other] = ['a', 'b'].map((digit) => file('recording-attempt-1.rrd', '', digit.repeat(64)));
  if (!one || !other) throw new Error('There are two.');
  expect(versionUrl(one, 'http://here')).toBe(
    'http://here/api/runs/run-1/files/recording-attempt-1.rrd?version=aaaaaaaaaaaa',
  );
  expect(versionUrl(other, 'http://here')).not.toBe(versionUrl(one, 'http://here'));
});

test('the command names the downloaded file, and the version is that of both packages', () => {
  expect(openCommand({ name: 'recording-attempt-1.rrd' })).toBe('rerun recording-attempt-1.rrd');
  const { dependencies } = JSON.parse(readFileSync('package.json', 'utf8'));
  expect(dependencies['@rerun-io/web-viewer']).toBe(RERUN_VERSION);
  expect(readFileSync('../pyproject.toml', 'utf8')).toContain(`"rerun-sdk==${RERUN_VERSION}"`);
});
