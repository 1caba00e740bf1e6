/** What only some roles may use; it is not there for the others, and the line at the page's head tells why. */
import type { ReactNode } from 'react';
import { type Role, useMay } from '@/lib/access';

interface Props {
  /** The least role that may. */
  least: Role;
  children: ReactNode;
  /** What the others see in its place. */
  otherwise?: ReactNode;
}

export function OnlyFor({ least, children, otherwise = null }: Props) {
  return useMay(least) ? children : otherwise;
}
