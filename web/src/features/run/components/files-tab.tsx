/** What the run has stored, to download. */
import { Anchor } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { CopyButton } from '@/components/copy-button';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { formatMoment, formatSize } from '@/lib/format';
import { filesQuery } from '../api/run-records';
import { isRecording, openCommand } from '../recordings';
import classes from './run.module.css';

export function FilesTab({ runId }: { runId: string }) {
  const { data, error } = useQuery(filesQuery(runId));
  if (error && !data) {
    return (
      <SentencePanel urgent title="The files cannot be shown">
        {sentence(error)}
      </SentencePanel>
    );
  }
  if (data?.files.length === 0) {
    return (
      <SentencePanel title="No files yet">Policies and the recording appear here after the first test.</SentencePanel>
    );
  }
  return (
    <div className={`card ${classes.tableFrame}`}>
      <table className={classes.table} aria-label="Files">
        <thead>
          <tr>
            <th scope="col">File</th>
            <th scope="col">Kind</th>
            <th scope="col">Size</th>
            <th scope="col">Stored</th>
            <th scope="col">SHA-256</th>
            <th scope="col">Open with</th>
          </tr>
        </thead>
        <tbody>
          {data?.files.map(({ name, kind, size, sha256, created_at, url }) => (
            <tr key={name}>
              <th scope="row">
                <Anchor href={url} download={name} fz="inherit">
                  {name}
                </Anchor>
              </th>
              <td>{kind}</td>
              <td className="number">{formatSize(size)}</td>
              <td className="number faint">{formatMoment(created_at)}</td>
              <td className="mono faint" title={sha256}>
                {sha256.slice(0, 12)}
              </td>
              <td>{isRecording({ name }) && <Command text={openCommand({ name })} />}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Command({ text }: { text: string }) {
  return (
    <span className={classes.command}>
      <code className="mono">{text}</code>
      <CopyButton text={text} label="Copy" />
    </span>
  );
}
