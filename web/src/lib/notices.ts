/** Telling of what has happened: each thing once. */
import type { Notice } from '@/client/schema.gen';

/** What tells a thing from every other one. */
export function noticeKey({ event, subject, occasion }: Notice): string {
  return `${event} ${subject} ${occasion}`;
}

/** Those that were not shown yet; they count as shown from now on. */
export function untold(notices: readonly Notice[], told: Set<string>): Notice[] {
  const fresh = notices.filter((notice) => !told.has(noticeKey(notice)));
  for (const notice of fresh) told.add(noticeKey(notice));
  return fresh;
}
