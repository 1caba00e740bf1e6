/** Choose what to train, see what it means, launch it. */
import { Button } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { getRouteApi } from '@tanstack/react-router';
import type { Choices } from '@/client/schema.gen';
import { AnchorLink, ButtonLink } from '@/components/anchor-link';
import { FirstSteps } from '@/components/first-steps';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { formatName } from '@/lib/format';
import { anyRunQuery, choicesQuery } from '@/lib/queries';
import { useLaunch } from './api/launch-runs';
import { AdvancedSettings } from './components/advanced-settings';
import classes from './components/launch.module.css';
import { LaunchChoices } from './components/launch-choices';
import { LaunchPlanPanel } from './components/launch-plan-panel';
import { fieldProblems } from './field-problems';
import type { LaunchSearch } from './search';
import { type Begin, useBegin } from './use-begin';
import { useLaunchForm } from './use-launch-form';

const route = getRouteApi('/launch');

export function LaunchPage() {
  const { data: choices, error, refetch } = useQuery(choicesQuery);
  const { data: runs } = useQuery(anyRunQuery);
  return (
    <>
      <title>New run · SLDR</title>
      <div className="page-head">
        <h1>New run</h1>
      </div>
      {runs?.total === 0 && <FirstSteps isAtForm />}
      {choices && <Beginning choices={choices} />}
      {error && !choices && (
        <SentencePanel
          urgent
          title="The choices cannot be shown"
          actions={<Button onClick={() => void refetch()}>Try again</Button>}
        >
          {sentence(error)}
        </SentencePanel>
      )}
    </>
  );
}

function Beginning({ choices }: { choices: Choices }) {
  const { from } = route.useSearch();
  const { begin, error, retry } = useBegin(choices, from);
  // A new key per run: what was typed for another one is gone.
  if (begin) return <Form key={from} choices={choices} begin={begin} />;
  if (!error) return <p className="faint">Looking…</p>;
  return (
    <SentencePanel
      urgent
      title="The run to launch again cannot be read"
      actions={
        <>
          <Button onClick={retry}>Try again</Button>
          <ButtonLink from="/launch" to="." search={(old) => ({ ...old, from: undefined })} variant="default">
            Begin without it
          </ButtonLink>
        </>
      }
    >
      {sentence(error)}
    </SentencePanel>
  );
}

function Form({ choices, begin }: { choices: Choices; begin: Begin }) {
  const search = route.useSearch();
  const navigate = route.useNavigate();
  const form = useLaunchForm(search, choices, begin);
  const launching = useLaunch();
  const refused = fieldProblems(launching.error, form.known);
  const problems = { ...refused.fields, ...form.problems };
  const choose = (changes: LaunchSearch): void => {
    launching.reset();
    void navigate({ search: (old) => ({ ...old, ...changes }), replace: true, resetScroll: false });
  };
  const submit = async (): Promise<void> => {
    if (form.launch === null) return;
    const { runs } = await launching.mutateAsync(form.launch);
    form.forget();
    const wanted = runs.filter((run) => run.phase === form.chosen.phase && run.method === form.chosen.method);
    const [only] = wanted;
    if (only !== undefined && wanted.length === 1) await navigate({ to: '/runs/$runId', params: { runId: only.id } });
    else await navigate({ to: '/' });
  };
  return (
    <form
      className={classes.form}
      aria-label="New run"
      noValidate
      onSubmit={(event) => {
        event.preventDefault();
        // A refusal is shown at its field.
        submit().catch(() => undefined);
      }}
    >
      <div className={classes.fields}>
        {begin.run && (
          <p className="faint">
            {'The form begins as '}
            <AnchorLink to="/runs/$runId" params={{ runId: begin.run.id }} fz="inherit">
              run {begin.run.id}
            </AnchorLink>
            {' was launched.'}
          </p>
        )}
        <LaunchChoices choices={choices} chosen={form.chosen} problems={problems} onChoose={choose} />
        <AdvancedSettings
          form={form}
          problems={problems}
          onType={(path, text) => {
            launching.reset();
            form.type(path, text);
          }}
        />
      </div>
      <LaunchPlanPanel
        form={form}
        problems={[...form.otherProblems, ...refused.others]}
        fieldProblems={Object.entries(problems).map(
          ([field, text]) => `${formatName(field.split('.').at(-1) ?? field)}: ${text}`,
        )}
        isLaunching={launching.isPending}
      />
    </form>
  );
}
