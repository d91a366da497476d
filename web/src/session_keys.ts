// SPDX-License-Identifier: Apache-2.0
import type { Drive } from './drive';
import type { Key } from './keys';
import type { Legend } from './legend';
import type { Presentation } from './present';
import type { Stage } from './stage';
import { type TimeBar, timeKeys } from './time_bar';
import type { Hands } from './touch';

const stopKeys: Key[] = [
  { keys: [], shown: 'space, Esc', does: 'stop: coils to zero at once, while it is armed', act: () => undefined },
];

/** Parts of a session's page that have keys. */
export interface Keyed {
  time: TimeBar;
  drive: Drive | undefined;
  hands: Hands | undefined;
  stage: Stage;
  legend: Legend;
  present: Presentation;
  more: Key[];
  isRig: boolean;
}

/** Keys of a session's page; on a rig space and Esc are those of its console. */
export function sessionKeys({ time, drive, hands, stage, legend, present, more, isRig }: Keyed): Key[] {
  const arrow = (by: number) => (event: KeyboardEvent) => {
    if (!drive?.key(event, true)) time.transport.seekBy(by * (event.shiftKey ? 10 : 1));
  };
  const [left, right] = drive ? [' · steer left', ' · steer right'] : ['', ''];
  const steer: Key[] = drive
    ? [{ keys: ['ArrowUp', 'ArrowDown'], shown: '↑ ↓', does: 'steer (Shift: slowly)', act: arrow(0) }]
    : [];
  const escape: Key = {
    keys: ['Escape'],
    shown: 'Esc',
    does: hands ? 'deselect the tool, leave the presentation' : 'leave the presentation',
    act: () => (present.isOn ? present.set(false) : hands?.choose(undefined)),
  };
  const use: Key[] = hands
    ? [{ keys: ['x'], shown: 'x', does: 'use the chosen tool at the middle of the view', act: () => hands.use() }]
    : [];
  return [
    ...(isRig ? stopKeys : timeKeys(time)),
    { keys: ['ArrowLeft'], shown: '←', does: `previous frame (Shift: ten)${left}`, act: arrow(-1) },
    { keys: ['ArrowRight'], shown: '→', does: `next frame (Shift: ten)${right}`, act: arrow(1) },
    ...steer,
    ...more,
    { keys: ['i'], shown: 'i', does: 'say what is at the middle of the view', act: stage.sayMiddle },
    { keys: ['k'], shown: 'k', does: 'fold the legend', act: legend.toggle },
    ...(isRig ? [] : [...present.keys, escape, ...use]),
  ];
}
