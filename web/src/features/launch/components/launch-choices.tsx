/** Task, phase, method, seeds and preset. */
import type { Choices } from '@/client/schema.gen';
import { ChoiceCards } from '@/components/choice-cards';
import { LocomotionChoice } from '@/components/locomotion-choice';
import { MethodHelpButton } from '@/components/method-help-button';
import { SeedsField } from '@/components/seeds-field';
import { formatName } from '@/lib/format';
import type { LaunchSearch } from '../search';
import type { Chosen } from '../use-launch-form';
import { TaskPicture } from './task-picture';
import { TaskSummary } from './task-summary';

const PHASES = {
  manipulation: 'The robot learns to move the object. Methods with SLDR bring the locomotion run they need.',
  locomotion: 'The object learns to move itself to its goal, without the robot.',
};

interface Props {
  choices: Choices;
  chosen: Chosen;
  problems: Readonly<Record<string, string>>;
  onChoose: (changes: LaunchSearch) => void;
}

export function LaunchChoices({ choices, chosen, problems, onChoose }: Props) {
  const method = choices.methods.find(({ name }) => name === chosen.method);
  return (
    <>
      <ChoiceCards
        legend="Task"
        width={230}
        value={chosen.task}
        problem={problems.task}
        onChange={(task) => onChoose({ task })}
        cards={choices.tasks.map((task) => ({
          value: task.name,
          title: task.name,
          summary: <TaskSummary task={task} />,
          picture: <TaskPicture url={task.picture_url} />,
        }))}
      />
      <ChoiceCards
        legend="Phase"
        width={260}
        value={chosen.phase}
        problem={problems.phase}
        onChange={(phase) => onChoose({ phase: phase as Chosen['phase'] })}
        cards={[...choices.phases]
          .reverse()
          .map((phase) => ({ value: phase, title: formatName(phase), summary: PHASES[phase] }))}
      />
      <ChoiceCards
        legend="Method"
        width={230}
        value={chosen.method}
        problem={problems.method}
        onChange={(method) => onChoose({ method })}
        cards={choices.methods.map((method) => ({
          value: method.name,
          title: method.name,
          summary: `${method.summary} In the paper: ${method.title}.`,
          help: <MethodHelpButton name={method.name} title={method.title} />,
          obstacle: method.phases.includes(chosen.phase)
            ? undefined
            : 'Only for manipulation: an object learns from the sparse reward alone.',
        }))}
      />
      <ChoiceCards
        legend="Preset"
        width={200}
        value={chosen.preset}
        problem={problems.preset}
        onChange={(preset) => onChoose({ preset })}
        cards={choices.presets.map((preset) => ({ value: preset.name, title: preset.name, summary: preset.summary }))}
      />
      {chosen.phase === 'manipulation' && method?.needs_locomotion && (
        <LocomotionChoice
          key={chosen.task}
          value={chosen.locomotion}
          problem={problems.locomotion}
          onChange={(locomotion) => onChoose({ locomotion })}
        />
      )}
      <SeedsField
        description="One run per seed: 0, or 0-4, or 1, 3, 7-9"
        seeds={chosen.seeds}
        problem={problems.seeds}
        onChange={(seeds) => onChoose({ seeds })}
      />
    </>
  );
}
