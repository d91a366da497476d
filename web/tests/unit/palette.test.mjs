// SPDX-License-Identifier: Apache-2.0
// Colours that meet in one picture differ to everybody, also in a grey print, and are those of the program's pictures.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { ciede2000, difference, kinds, seen } from './colour_vision.mjs';
import { source } from './source.mjs';

const { mixed, palettes } = await source('palette');
const least = 8; // CIEDE2000; two areas side by side are told apart from about 2

test('CIEDE2000 gives the values of its authors', () => {
  const pairs = [
    [[50, 2.6772, -79.7751], [50, 0, -82.7485], 2.0425],
    [[50, -0.001, 2.49], [50, 0.0011, -2.49], 4.7461],
    [[22.7233, 20.0904, -46.694], [23.0331, 14.973, -42.5619], 2.0373],
  ];
  for (const [a, b, value] of pairs) assert.ok(Math.abs(ciede2000(a, b) - value) < 1e-4);
  assert.ok(ciede2000(seen(0xffffff, 'normal'), [100, 0, 0]) < 0.1);
});

/** Pairs of names that are nearer than `least`, as some kind of vision sees them. */
function tooNear(colours, pairs, visions = kinds) {
  return pairs.flatMap(([a, b]) =>
    visions
      .map((kind) => [`${a} and ${b}, ${kind}`, difference(colours[a], colours[b], kind)])
      .filter(([, far]) => far < least)
      .map(([name, far]) => `${name}: ${far.toFixed(1)}`),
  );
}

function allPairs(names) {
  return names.flatMap((a, i) => names.slice(i + 1).map((b) => [a, b]));
}

for (const theme of ['light', 'dark']) {
  const palette = palettes[theme];
  const { radar, paper } = palette;

  test(`${theme}: lines of one picture differ, and from the paper`, () => {
    const lines = { ...palette, chosen: radar.chosen };
    assert.deepEqual(tooNear(lines, allPairs(['paper', 'path', 'trail', 'tree', 'circle'])), []);
    const marks = ['path', 'trail', 'tree'].map((line) => ['goal', line]);
    assert.deepEqual(tooNear(lines, [...marks, ['chosen', 'path'], ['chosen', 'trail']]), []);
    assert.deepEqual(tooNear(lines, [['goal', 'circle']], kinds.slice(0, 4)), []); // in grey their shapes tell
  });

  test(`${theme}: swarm, obstacle, wall and paper differ`, () => {
    assert.deepEqual(tooNear(palette, allPairs(['paper', 'swarm', 'obstacle'])), []);
    assert.deepEqual(
      tooNear(palette, [
        ['swarm', 'wall'],
        ['obstacle', 'wall'],
        ['paper', 'wall'],
      ]),
      [],
    );
  });

  test(`${theme}: directions of the radar differ by their fate, and from the obstacles`, () => {
    const over = (name, i) => mixed(paper, radar[name], radar.alpha[i]);
    const fates = {
      kept: over('kept', 0),
      obstacle: over('obstacle', 1),
      wall: over('wall', 2),
      turn: over('turn', 3),
    };
    assert.deepEqual(tooNear(fates, allPairs(Object.keys(fates))), []);
    const meanings = { ...fates, disc: palette.obstacle, safety: radar.safety };
    const colourful = kinds.slice(0, 4);
    assert.deepEqual(
      tooNear(
        meanings,
        [
          ['obstacle', 'disc'],
          ['turn', 'safety'],
        ],
        colourful,
      ),
      [],
    );
  });

  test(`${theme}: circles of the radar differ`, () => {
    assert.deepEqual(tooNear(radar, allPairs(['detection', 'safety', 'prediction'])), []);
  });

  test(`${theme}: few robots differ, regions differ from each other and from the robots`, () => {
    const colourful = kinds.slice(0, 4); // in grey the numbers beside them tell
    const { robots, regions } = palette;
    assert.deepEqual(tooNear(robots, allPairs([...robots.keys()]), colourful), []);
    const mapped = [...regions, palette.swarm];
    assert.deepEqual(tooNear(mapped, allPairs([...mapped.keys()]), colourful), []);
  });
}

test("the light colours are those of the program's pictures", () => {
  const file = join(dirname(fileURLToPath(import.meta.url)), '../../../src/microswarm/report/colours.hpp');
  const text = readFileSync(file, 'utf8');
  const found = [...text.matchAll(/Colour (\w+) = colour_of\(0x([0-9a-f]{6})/g)];
  const names = { wall_edge: 'wallEdge' };
  const own = new Set(['wait_zone']); // only in the program's pictures
  assert.ok(found.length >= 20);
  for (const [, name, value] of found) {
    if (own.has(name)) continue;
    const page = name.startsWith('radar_') ? palettes.light.radar[name.slice(6)] : palettes.light[names[name] ?? name];
    assert.equal(page?.toString(16).padStart(6, '0'), value, name);
  }
  const [, robots] = /array<Colour, 8> robots\{([^;]*)\}/.exec(text);
  assert.deepEqual(
    [...robots.matchAll(/0x([0-9a-f]{6})/g)].map(([, one]) => parseInt(one, 16)),
    palettes.light.robots,
  );
});
