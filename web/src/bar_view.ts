// SPDX-License-Identifier: Apache-2.0
import type { Standing } from './protocol';
import { speeds } from './speeds';
import type { Transport } from './transport';

/** State of the bar's buttons. */
export function barView(
  time: Pick<Transport, 'anyPlays' | 'allEnded' | 'isOver'>,
  standing: Pick<Standing, 'frame' | 'frames' | 'growing' | 'speed'>,
  isRecord: boolean,
  looksBack: boolean,
) {
  const { anyPlays: plays, allEnded: ended, isOver: over } = time;
  const isNewest = !looksBack && (!isRecord || standing.frame + 1 >= standing.frames);
  return {
    play: plays ? '❚❚ Pause' : over ? '↻ Restart' : '▶ Play',
    playTitle: `${plays ? 'Pause' : over ? 'Restart' : 'Play'} (space)`,
    canPlay: !ended || plays || isRecord || over,
    canStep: !ended,
    isNewest,
    hasLive: !isRecord || standing.growing,
    speed: String(speeds.includes(standing.speed) ? standing.speed : 1),
  };
}
