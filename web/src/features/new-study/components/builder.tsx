/** The form of a new study: choices, settings, the matrix of what would run, and the button. */
import { getRouteApi } from '@tanstack/react-router';
import type { Choices, StudyTemplate } from '@/client/schema.gen';
import { ChoiceCards } from '@/components/choice-cards';
import { LocomotionChoice } from '@/components/locomotion-choice';
import { MethodHelpButton } from '@/components/method-help-button';
import { SeedsField } from '@/components/seeds-field';
import { useLaunchStudy } from '@/lib/use-launch-study';
import { type Draft, draftOf, useDraft } from '../use-draft';
import classes from './builder.module.css';
import { LaunchPanel } from './launch-panel';
import { NameChecks } from './name-checks';
import { PreviewMatrix } from './preview-matrix';
import { SettingRows } from './setting-rows';
import { Templates } from './templates';

interface Props {
  choices: Choices;
  templates: readonly StudyTemplate[];
  begin: Draft;
  /** What the draft begins with, in one word. */
  beginning: string;
}

const route = getRouteApi('/studies/new');

export function Builder({ choices, templates, begin, beginning }: Props) {
  const form = useDraft(begin, beginning, choices);
  const { draft, problems } = form;
  const launching = useLaunchStudy();
  const navigate = route.useNavigate();
  const choose = (changes: Partial<Draft>): void => {
    launching.reset();
    form.choose(changes);
  };
  const submit = (): void => {
    if (form.spec === null) return;
    launching
      .mutateAsync(
        { name: form.name, note: '', spec: form.spec },
        { onSuccess: ({ study_id }) => void navigate({ to: '/studies/$studyId', params: { studyId: study_id } }) },
      )
      // A refusal is shown beside the button.
      .then(form.forget, () => undefined);
  };
  return (
    <form
      className={classes.form}
      aria-label="New study"
      noValidate
      onSubmit={(event) => {
        event.preventDefault();
        submit();
      }}
    >
      <div className={classes.fields}>
        <Templates templates={templates} onChoose={({ title, spec }) => choose(draftOf(spec, title))} />
        <NameChecks
          legend="Tasks"
          known={choices.tasks.map(({ name, goal_text }) => ({ name, summary: goal_text }))}
          chosen={draft.tasks}
          problem={problems.tasks}
          onChange={(tasks) => choose({ tasks })}
        />
        <NameChecks
          legend="Methods"
          known={choices.methods.map(({ name, title, summary }) => ({
            name,
            summary,
            help: <MethodHelpButton name={name} title={title} />,
          }))}
          chosen={draft.methods}
          problem={problems.methods}
          onChange={(methods) => choose({ methods })}
        />
        <SeedsField
          description="0-4, or 1, 3, 7-9. Bands and intervals need three or more."
          seeds={draft.seeds}
          problem={problems.seeds}
          onChange={(seeds) => choose({ seeds })}
        />
        <ChoiceCards
          legend="Preset"
          width={200}
          value={draft.preset}
          onChange={(preset) => choose({ preset })}
          cards={choices.presets.map(({ name, summary }) => ({ value: name, title: name, summary }))}
        />
        {draft.methods.some((name) => choices.methods.find((method) => method.name === name)?.needs_locomotion) && (
          <LocomotionChoice value={draft.locomotion} onChange={(locomotion) => choose({ locomotion })} />
        )}
        <SettingRows form={form} onChange={choose} />
        {form.spec && form.preview && <PreviewMatrix spec={form.spec} preview={form.preview} />}
      </div>
      <LaunchPanel
        form={form}
        refusal={launching.error}
        isLaunching={launching.isPending}
        onName={(name) => choose({ name })}
      />
    </form>
  );
}
