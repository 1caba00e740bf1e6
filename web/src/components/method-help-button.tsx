/** What a method does, its equations, and when to choose it. */
import { EquationLine } from '@/components/equation-line';
import { HelpButton } from '@/components/help-button';
import { METHOD_HELP } from '@/lib/method-help';

interface Props {
  name: string;
  /** What the paper calls it. */
  title: string;
}

export function MethodHelpButton({ name, title }: Props) {
  const help = METHOD_HELP[name];
  if (help === undefined) return null;
  return (
    <HelpButton about={name}>
      <p>
        <b>{name}</b> <span className="faint">{title} in the paper</span>
      </p>
      <p>{help.does}</p>
      {help.equations.map((equation) => (
        <EquationLine key={equation} name={equation} />
      ))}
      <p>{help.choose}</p>
    </HelpButton>
  );
}
