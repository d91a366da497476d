// SPDX-License-Identifier: Apache-2.0
import type { Drive } from './drive';
import type { Key } from './keys';
import { type TimeBar, timeKeys } from './time_bar';
import type { Hands } from './touch';

const stopKeys: Key[] = [
  { keys: [], shown: 'space, Esc', does: 'stop: coils to zero at once, while it is armed', act: () => undefined },
];

/** Keys of a session's page; on a rig space and Esc are those of its console. */
export function sessionKeys(
  time: TimeBar,
  drive: Drive | undefined,
  hands: Hands | undefined,
  more: Key[],
  isRig: boolean,
): Key[] {
  const arrow = (by: number) => (event: KeyboardEvent) => {
    if (!drive?.key(event, true)) time.transport.seekBy(by * (event.shiftKey ? 10 : 1));
  };
  const [left, right] = drive ? [' · steer left', ' · steer right'] : ['', ''];
  const steer: Key[] = drive
    ? [{ keys: ['ArrowUp', 'ArrowDown'], shown: '↑ ↓', does: 'steer (Shift: slowly)', act: arrow(0) }]
    : [];
  const tools: Key[] = hands
    ? [
        { keys: ['Escape'], shown: 'Esc', does: 'deselect the tool', act: () => hands.choose(undefined) },
        { keys: ['x'], shown: 'x', does: 'use the chosen tool at the middle of the view', act: () => hands.use() },
      ]
    : [];
  return [
    ...(isRig ? stopKeys : timeKeys(time)),
    { keys: ['ArrowLeft'], shown: '←', does: `previous frame (Shift: ten)${left}`, act: arrow(-1) },
    { keys: ['ArrowRight'], shown: '→', does: `next frame (Shift: ten)${right}`, act: arrow(1) },
    ...steer,
    ...more,
    ...(isRig ? [] : tools),
  ];
}
