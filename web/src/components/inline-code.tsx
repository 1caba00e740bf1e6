/** A sentence in which `words between backticks` are code. */
export function InlineCode({ text }: { text: string }) {
  const parts = text.split('`');
  return (
    <>
      {parts.map((part, at) =>
        // Every second part stood between backticks; the parts never move.
        // biome-ignore lint/suspicious/noArrayIndexKey: the parts of a fixed sentence keep their places
        at % 2 === 1 ? <code key={at}>{part}</code> : part,
      )}
    </>
  );
}
