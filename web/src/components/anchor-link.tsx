/** Mantine's look on the router's links. */
import { Anchor, type AnchorProps, Button, type ButtonProps } from '@mantine/core';
import { createLink, type LinkComponent } from '@tanstack/react-router';
import { forwardRef, type ReactNode } from 'react';

const RoutedAnchor = createLink(
  forwardRef<HTMLAnchorElement, AnchorProps & { children?: ReactNode; tabIndex?: number; onFocus?: () => void }>(
    (props, ref) => <Anchor ref={ref} {...props} />,
  ),
);

const RoutedButton = createLink(
  forwardRef<HTMLAnchorElement, ButtonProps & { children?: ReactNode }>((props, ref) => (
    <Button component="a" ref={ref} {...props} />
  )),
);

/** A text link to a page. */
export const AnchorLink: LinkComponent<typeof RoutedAnchor> = (props) => <RoutedAnchor preload="intent" {...props} />;

/** A button that goes to a page. */
export const ButtonLink: LinkComponent<typeof RoutedButton> = (props) => <RoutedButton preload="intent" {...props} />;
