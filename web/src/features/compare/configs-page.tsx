/** By what runs differ: the switches between their methods, and every setting in which they are not alike. */
import { useQuery } from '@tanstack/react-query';
import { getRouteApi } from '@tanstack/react-router';
import type { ComparedConfig, ConfigComparison, MethodPair } from '@/client/schema.gen';
import { AnchorLink, ButtonLink } from '@/components/anchor-link';
import { NumberTable } from '@/components/number-table';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { formatPlural, NOTHING } from '@/lib/format';
import { configsQuery } from './api/get-configs';
import classes from './components/configs.module.css';
import { partsOf } from './search';

const route = getRouteApi('/compare/configs');

export function ConfigsPage() {
  const runIds = partsOf(route.useSearch().runs);
  const { data, error } = useQuery(configsQuery(runIds));
  const isOfObjects = data?.runs.every((run) => run.phase === 'locomotion') ?? false;
  return (
    <>
      <title>What differs · SLDR</title>
      <div className="page-head">
        <h1>What differs</h1>
        <span className="faint number">{data && formatPlural(data.runs.length, 'run')}</span>
        <ButtonLink
          to="/compare"
          search={{ runs: runIds.join(','), phase: isOfObjects ? 'locomotion' : undefined }}
          variant="default"
          ml="auto"
        >
          Compare their curves
        </ButtonLink>
      </div>
      {runIds.length === 0 && (
        <SentencePanel title="No run is named" actions={<ButtonLink to="/">All runs</ButtonLink>}>
          Choose two runs or more in the runs table, or come here from a comparison.
        </SentencePanel>
      )}
      {error && (
        <SentencePanel urgent title="The configs cannot be compared" actions={<ButtonLink to="/">All runs</ButtonLink>}>
          {sentence(error)}
        </SentencePanel>
      )}
      {data && <Differences comparison={data} />}
    </>
  );
}

function Differences({ comparison: { runs, settings, shared, methods } }: { comparison: ConfigComparison }) {
  return (
    <>
      {methods.map((pair) => (
        <Switches key={`${pair.first} ${pair.second}`} pair={pair} />
      ))}
      <section className={`card ${classes.panel}`} aria-label="Settings">
        <h2>Settings that differ</h2>
        <p className="faint">
          {formatPlural(shared, 'further setting')} {shared === 1 ? 'is' : 'are'} alike and not shown.
        </p>
        {settings.length === 0 ? (
          <p>The runs have the same config.</p>
        ) : (
          <>
            <NumberTable
              name="Settings that differ"
              columns={['Setting', ...runs.map(titleOf)]}
              rows={settings.map(({ name, values }) => [
                <code key={name} className="mono">
                  {name}
                </code>,
                ...values.map((value) => value ?? NOTHING),
              ])}
              wordColumns={runs.length + 1}
            />
            <p className={classes.runs}>
              {runs.map((run) => (
                <AnchorLink key={run.run_id} to="/runs/$runId" params={{ runId: run.run_id }} fz={12.5}>
                  {titleOf(run)}
                </AnchorLink>
              ))}
            </p>
          </>
        )}
      </section>
    </>
  );
}

/** The id tells apart what is alike in all else. */
function titleOf({ run_id, task, method, seed }: ComparedConfig): string {
  return `${task}, ${method}, seed ${seed} (${run_id.slice(0, 4)})`;
}

function Switches({ pair: { first, second, switches } }: { pair: MethodPair }) {
  return (
    <section className={`card ${classes.panel}`} aria-label={`${first} or ${second}`}>
      <h2>
        From {first} to {second}
      </h2>
      {switches.length === 0 ? (
        <p>The two methods are made of the same parts.</p>
      ) : (
        <NumberTable
          name={`Switches from ${first} to ${second}`}
          columns={['Switch', first, second]}
          rows={switches.map(({ title, first: one, second: other }) => [title, one, other])}
          wordColumns={3}
        />
      )}
    </section>
  );
}
