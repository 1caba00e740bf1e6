/** Why a run waits or ended so; the runs it names are links. */
import { AnchorLink } from '@/components/anchor-link';

interface Props {
  text: string;
  /** Ids of the runs that the text may name. */
  runIds: readonly string[];
  /** How a named run stands, if that is known. */
  describe?: (runId: string) => string;
}

export function Reason({ text, runIds, describe = () => '' }: Props) {
  const named = runIds.find((id) => text.includes(id));
  if (named === undefined) return <span>{text}</span>;
  const [before, ...after] = text.split(named);
  return (
    <span>
      {before}
      <AnchorLink to="/runs/$runId" params={{ runId: named }} fz="inherit">
        {named}
      </AnchorLink>
      {describe(named)}
      {after.join(named)}
    </span>
  );
}
