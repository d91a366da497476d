// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Live } from './live';
import { number } from './numbers';
import type { RigInfo, RigStanding } from './protocol';
import { nearness } from './rig_limits';
import { type Entry, logged, newsOf, sights } from './rig_log';
import { barOf, staleWords } from './rig_view';

const latencies: [keyof NonNullable<RigStanding['latency_ms']>, string][] = [
  ['frame_age', 'Age of a frame'],
  ['vision', 'Vision'],
  ['tick', 'Tick'],
  ['camera_to_current', 'Camera to current'],
  ['coil_late', 'Currents late'],
  ['round_trip', 'Coil driver'],
];
/** Numbers of a rig: currents, temperatures, field, limits, latencies. Those that are not of now are grey and say of when. */
export function rigTab(live: Live): HTMLElement {
  const root = element('div', { class: 'rig-numbers' });
  const list = element('ol', { class: 'rig-log', 'aria-label': 'Events of the rig' });
  const whole = element('div', {}, root, element('h2', {}, 'Events'), list);
  let log: Entry[] = [];
  const note = (text: string) => {
    log = logged(log, text, new Date(), now?.t_s);
    list.replaceChildren(...log.map(line));
  };
  let drawn = 0;
  let later: number | undefined;
  let numbers: RigStanding | undefined;
  let now: RigStanding | undefined;
  let isLost = false;
  const draw = () => {
    window.clearTimeout(later);
    if (!numbers || !now) return;
    const runs = now.state === 'dry' || now.state === 'armed';
    if (runs && root.isConnected) later = window.setTimeout(draw, 1000); // they become old without a message
    const stale = staleWords(now, numbers, isLost, live.silence);
    root.classList.toggle('stale', stale !== '');
    root.replaceChildren(
      ...(stale ? [element('p', { class: 'when', role: 'status' }, stale)] : []),
      ...sections(numbers, live.hello?.rig_info),
    );
  };
  live.listen((message) => {
    if (message.type !== 'rig') return;
    const isSame = now?.state === message.state;
    const news = newsOf(now, message, live.hello?.rig_info);
    now = message;
    news.forEach(note);
    if (message.currents_a) numbers = message;
    if (isSame && performance.now() - drawn < 90) return;
    drawn = performance.now();
    draw();
  });
  live.onState((state) => {
    if (isLost !== (state !== 'open')) note(isLost ? 'The connection is back.' : 'The connection to the lab is lost.');
    isLost = state !== 'open';
    draw();
  });
  return whole;
}

/** A line of the log, with the time of day and of the run. */
function line({ at, t_s, text, count }: Entry): HTMLElement {
  const time = at.toLocaleTimeString([], { hour12: false });
  const run = t_s === undefined ? '' : `${t_s.toFixed(1)} s`;
  return element(
    'li',
    {},
    element('time', { datetime: at.toISOString() }, time),
    element('span', { class: 'unit' }, run),
    element('span', {}, count > 1 ? `${text} (${count} times)` : text),
  );
}

function sections(rig: RigStanding, info: RigInfo | undefined): HTMLElement[] {
  const title = rig.state === 'dry' ? 'Currents that would be driven' : 'Currents';
  return [
    element('h2', {}, title),
    bars(rig.currents_a ?? [], info?.coils ?? [], info?.max_current_a ?? [], 'A'),
    element('h2', {}, 'Temperatures'),
    bars(rig.temperatures_c ?? [], info?.coils ?? [], info?.max_temperature_c ?? [], '°C'),
    element('h2', {}, 'Field'),
    field(rig.field_mt ?? [0, 0, 0], info?.field_mt ?? 1),
    element('h2', {}, 'State'),
    table([
      ['Swarm', sights[rig.sight ?? ''] ?? rig.sight ?? ''],
      ...(rig.robots ? [['Robots unseen', `${rig.unseen ?? 0} of ${rig.robots}`] as [string, string]] : []),
      ['Gap to walls and obstacles', rig.gap_um == null ? '–' : `${number(rig.gap_um, 3)} µm`],
      ['Commanded speed', `${number(rig.speed_um_per_s ?? 0, 3)} µm/s`],
      ['Share allowed by the coils', share(rig.scale ?? 1)],
      ['Share allowed by the device', share(rig.device_scale ?? 1)],
      ['Ticks, missed deadlines', `${rig.ticks ?? 0}, ${rig.missed_deadlines ?? 0}`],
      ['Frames used', String(rig.frames ?? 0)],
      ['Frames skipped for newer ones', String(rig.dropped_frames ?? 0)],
      ['Frames lost or late at the camera', String(rig.frame_gaps ?? 0)],
      ['Frames without the swarm or a robot', String(rig.unseen_frames ?? 0)],
      ['Device switched itself off', String(rig.resumed ?? 0)],
    ]),
    element('h2', {}, 'Latencies [ms]'),
    element(
      'table',
      { class: 'metrics' },
      element('thead', {}, row('th', ['', 'p50', 'p95', 'p99'])),
      element(
        'tbody',
        {},
        ...latencies.map(([key, label]) =>
          row('td', [label, ...(rig.latency_ms?.[key] ?? []).map((one) => number(one, 3))]),
        ),
      ),
    ),
  ];
}

function share(value: number): string {
  return value >= 1 - 1e-9 ? 'all' : `${number(100 * value, 3)} %`;
}

function row(kind: 'th' | 'td', cells: string[]): HTMLElement {
  return element(
    'tr',
    {},
    ...cells.map((one, i) => element(i === 0 && one !== '' ? 'th' : one === '' ? 'td' : kind, {}, one)),
  );
}

function table(rows: [string, string][]): HTMLElement {
  return element('table', { class: 'metrics' }, element('tbody', {}, ...rows.map((one) => row('td', one))));
}

/** A bar for each value relative to its limit; signed values begin in the middle. */
function bars(values: number[], names: string[], limits: (number | null)[], unit: string): HTMLElement {
  const signed = unit === 'A';
  return element(
    'div',
    { class: 'bars' },
    ...values.flatMap((value, i) => {
      const limit = limits[i] ?? null;
      const most = limit ?? Math.max(1, ...values.map(Math.abs));
      const name = names[i] ?? String(i);
      const text = `${signed && value > 0 ? '+' : ''}${value.toFixed(signed ? 2 : 1)}${limit === null ? '' : ` / ${number(limit, 3)}`} ${unit}`;
      const { from, to } = barOf(value, most, signed);
      const near = nearness(value, limit);
      const fill = element('span', { class: `fill ${near.split(' ')[0] ?? ''}` });
      fill.style.left = `${100 * from}%`;
      fill.style.right = `${100 * (1 - to)}%`;
      const bar = element(
        'span',
        { class: signed ? 'bar signed' : 'bar', role: 'img', 'aria-label': `${name}: ${text}${near && `, ${near}`}` },
        fill,
      );
      const shown = element('span', { class: 'value' }, text);
      return [element('span', {}, name), bar, shown, ...(near ? [element('strong', { class: 'near' }, near)] : [])];
    }),
  );
}

/** The in-plane field as an arrow in a circle of its amplitude, and in numbers. */
function field([x, y, z]: [number, number, number], amplitude: number): HTMLElement {
  const space = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(space, 'svg');
  svg.setAttribute('viewBox', '-1.15 -1.15 2.3 2.3');
  svg.setAttribute('class', 'field-vector');
  svg.setAttribute('role', 'img');
  svg.setAttribute('aria-label', 'Field in the plane');
  const draw = (tag: string, attributes: { [name: string]: number }) => {
    const one = document.createElementNS(space, tag);
    for (const [name, value] of Object.entries(attributes)) one.setAttribute(name, String(value));
    svg.append(one);
  };
  draw('circle', { r: 1 });
  draw('line', { x2: x / amplitude, y2: -y / amplitude });
  draw('circle', { cx: x / amplitude, cy: -y / amplitude, r: 0.07 });
  const text = `x ${x.toFixed(2)}, y ${y.toFixed(2)}, z ${z.toFixed(2)} mT; ${number(Math.hypot(x, y, z), 3)} mT in all`;
  return element('div', { class: 'field-row' }, svg, element('span', {}, text));
}
