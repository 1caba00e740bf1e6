/** Tell whoever may only look why the page offers nothing to change. */
import { useQuery } from '@tanstack/react-query';
import { allows, meQuery } from '@/lib/access';
import classes from './shell.module.css';

export function RoleNote() {
  const caller = useQuery(meQuery).data?.caller;
  if (!caller || allows(caller.role, 'operator')) return null;
  return (
    <p className={classes.note}>
      You are signed in as {caller.name}, a {caller.role}: you see everything and change nothing. An admin can give you
      the role operator.
    </p>
  );
}
