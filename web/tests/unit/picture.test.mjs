// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { corners, triangles } = await source('scene/quads');
const { Inputs, insetAt } = await source('scene/inputs');
const { Trails } = await source('scene/trails');
const { View } = await source('scene/view');
const { isUnfolded } = await source('scene/key');
const { linkOf } = await source('present');
const { robotsAtGoal } = await source('gathering');
const { centresOf } = await source('scene/motion');

test('a line is a rectangle of its width', () => {
  const found = corners(new Float32Array([0, 0, 10, 0]), new Uint32Array([0, 1]), 2, new Float32Array(8));
  assert.deepEqual([...found], [0, 1, 10, 1, 10, -1, 0, -1]);
  const point = corners(new Float32Array([3, 4]), new Uint32Array([0, 0]), 2, new Float32Array(8));
  assert.deepEqual([...point], [3, 4, 3, 4, 3, 4, 3, 4]); // the root of a tree is its own parent
  assert.deepEqual([...triangles(2)].slice(6), [4, 5, 6, 4, 6, 7]);
});

test('lines keep their width in CSS pixels at any zoom, and are bolder in a presentation', () => {
  const view = new View();
  view.scale = 4;
  assert.equal(view.line(2), 0.5);
  view.bold = 2;
  assert.equal(view.line(2), 1);
  assert.equal(view.um(2), 0.5);
});

test('inputs are remembered without repetitions and holds, and begin anew after a jump back', () => {
  const inputs = new Inputs();
  const steps = [
    [1, 5],
    [1, 5],
    [2, 0],
    [3, 5],
  ];
  steps.forEach(([heading, speed], i) => inputs.take(i, { heading, speed }));
  assert.deepEqual(inputs.now, { heading: 3, speed: 5 });
  assert.deepEqual(inputs.past, [{ heading: 1, speed: 5 }]);
  inputs.take(0, { heading: 9, speed: 5 });
  assert.deepEqual(inputs.past, []);
});

test('the inset is beside the map where there is room', () => {
  const map = { lo: [100, 60], hi: [600, 560] };
  assert.deepEqual(insetAt({ width: 800, head: 60, map }, 40, 10), { at: [650, 100], factor: 1 });
  const left = { lo: [200, 60], hi: [790, 560] };
  assert.deepEqual(insetAt({ width: 800, head: 60, map: left }, 40, 10), { at: [150, 100], factor: 1 });
  const wide = { lo: [10, 200], hi: [790, 560] };
  assert.deepEqual(insetAt({ width: 800, head: 60, map: wide }, 40, 10), { at: [768, 82], factor: 0.55 });
});

test('trails of robots end where frames are left out, or there are too many', () => {
  const trails = new Trails();
  const at = (x) => new Float32Array([x, 0, x, 1]);
  trails.take(0, at(0));
  trails.take(1, at(1));
  trails.take(1, at(1));
  assert.deepEqual(trails.of(1), [0, 1, 1, 1]);
  trails.take(9, at(9));
  assert.deepEqual(trails.of(0), [9, 0]);
  trails.take(2, at(2));
  assert.deepEqual(trails.of(0), [2, 0]);
  trails.take(3, new Float32Array(2000));
  assert.equal(trails.count, 0);
});

test('the legend is folded at first on a phone only', () => {
  assert.deepEqual(
    [isUnfolded(null, 1280), isUnfolded(null, 390), isUnfolded('open', 390), isUnfolded('folded', 1280)],
    [true, false, true, false],
  );
});

test('the link keeps the presentation', () => {
  assert.equal(linkOf('#/session/7', true), '#/session/7/present');
  assert.equal(linkOf('#/session/7/present', true), '#/session/7/present');
  assert.equal(linkOf('#/session/7/present', false), '#/session/7');
});

test('robots at their common goal are a metric', () => {
  const robots = new Uint8Array(new Float32Array([0, 0, 3, 0, 30, 0]).buffer);
  const scenario = { goal_um: [0, 0], goal_tolerance_um: 5, robots: {} };
  assert.deepEqual(robotsAtGoal({ robots }, scenario), { robots_at_the_goal: 2, robots: 3 });
  assert.deepEqual(robotsAtGoal({ robots: new Uint8Array() }, scenario), {});
  assert.deepEqual(
    robotsAtGoal(
      { robots },
      {
        robots: {
          goals_um: [
            [0, 0],
            [1, 1],
            [2, 2],
          ],
        },
      },
    ),
    {},
  );
});

test('centres of obstacles go by their numbers', () => {
  const discs = new Float32Array([1, 2, 5, 4]);
  const solids = [{ rings: [new Float32Array([0, 0, 2, 0, 2, 2, 0, 2])], number: 9 }];
  assert.deepEqual(
    [...centresOf({ discs, solids })],
    [
      [4, [1, 2]],
      [9, [1, 1]],
    ],
  );
});
