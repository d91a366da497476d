// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const hover = await source('scene/hover');
const { placeOf } = await source('hover_tip');
const { kept } = await source('scene/key');

const beam = (degrees, fate, score = 0, obstacle = -1) => ({
  heading: (degrees * Math.PI) / 180,
  fate,
  score,
  obstacle,
});
const beams = [
  beam(0, 1, 0, 3),
  beam(90, 0, 0.31),
  beam(180, 2),
  beam(270, 1, 0, 7),
  beam(300, 3, 0.2),
  beam(330, 0, 0.1),
];

test('a sector is the nearest direction, across the turn too', () => {
  assert.equal(hover.beamAt(beams, 10, 1), beams[0]);
  assert.equal(hover.beamAt(beams, 10, -1), beams[0]);
  assert.equal(hover.beamAt(beams, -1, 9), beams[1]);
  assert.equal(hover.beamAt(beams, 5, -9), beams[4]);
});

test('a sector says what screened it, or its score', () => {
  assert.equal(hover.sectorText(beams[0], false, 25).title, 'Direction 0°: screened by obstacle 3');
  assert.equal(hover.sectorText(beam(0, 1), false, 25).title, 'Direction 0°: screened by an obstacle');
  assert.equal(hover.sectorText(beams[2], false, 25).title, 'Direction 180°: screened by a wall');
  assert.match(hover.sectorText(beams[2], false, 25).lines[0], /25 µm/);
  assert.equal(hover.sectorText(beams[4], false, 25).title, 'Direction 300°: turns too far');
  assert.match(hover.sectorText(beams[5], false, 25).lines[0], /φ 0\.1\b/);
  assert.match(hover.sectorText(beams[1], true, 25).title, /chosen/);
});

test('the choice is explained by what was kept and what fell away', () => {
  const { title, lines } = hover.choiceText(beams, 1, undefined);
  assert.equal(title, 'Chosen direction 90°');
  assert.deepEqual(lines, [
    'The highest score φ 0.31 of 2 directions kept.',
    '2 are screened by obstacles 3 and 7.',
    '1 is screened by walls.',
    '1 turns too far.',
    'φ is high towards the goal and away from the nearest obstacle.',
  ]);
  assert.match(hover.choiceText(beams, undefined, 0.5).lines[0], /detection circle/);
  assert.match(hover.choiceText([beams[0]], undefined, undefined).title, /No direction/);
});

test('lines are hit by distance', () => {
  assert.equal(hover.distanceTo([0, 0, 10, 0], [5, 3]), 3);
  assert.equal(hover.distanceTo([], [5, 3]), Infinity);
  assert.equal(hover.lengthOf([0, 0, 3, 4, 3, 5]), 6);
  const points = new Float32Array([0, 0, 10, 0, 10, 10]);
  const pairs = [0, 0, 1, 0, 2, 1]; // a root that is its own parent
  assert.equal(hover.segmentAt(points, pairs, [9.5, 6], 1), 2);
  assert.equal(hover.segmentAt(points, pairs, [5, 5], 1), -1);
});

test('a swarm says its gap to what is nearest', () => {
  const frame = {
    radius_um: 50,
    heading_rad: Math.PI / 2,
    speed_um_per_s: 80,
    wall_clearance_um: 200,
    obstacle_clearance_um: 81,
    goal_distance_um: 1234,
  };
  assert.deepEqual(hover.swarmText(frame, 'vortex'), {
    title: 'Swarm, a vortex',
    lines: ['Radius 50 µm, heading 90°, speed 80 µm/s.', 'Gap of 31 µm to the next obstacle.', '1234 µm to the goal.'],
  });
  const alone = { ...frame, wall_clearance_um: null, obstacle_clearance_um: null };
  assert.ok(!hover.swarmText(alone, '').lines.join().includes('Gap'));
});

test('obstacles say how they move', () => {
  assert.deepEqual(hover.motionText([0, -12]), ['Moves at 12 µm/s to 270°.']);
  assert.deepEqual(hover.motionText([0, 0]), ['Rests.']);
  assert.deepEqual(hover.motionText(undefined), []);
});

test('robots are counted at the goal and in a pile', () => {
  const robots = new Float32Array([0, 0, 1, 0, 1.2, 0, 30, 0]);
  assert.equal(hover.gathered(robots, [0, 0], 1.1), 2);
  assert.deepEqual(hover.robotAt(robots, [1.3, 0], 5, 0.5), { index: 2, count: 2 });
  assert.deepEqual(hover.robotAt(robots, [29, 0], 5, 0.5), { index: 3, count: 1 });
  assert.equal(hover.robotAt(robots, [15, 0], 5, 0.5), undefined);
});

test('the tip is beside the pointer and within the picture', () => {
  assert.deepEqual(placeOf([100, 100], [80, 40], [800, 600]), [116, 116]);
  assert.deepEqual(placeOf([790, 590], [80, 40], [800, 600]), [694, 534]);
  assert.deepEqual(placeOf([50, 10], [300, 40], [310, 600]), [0, 26]);
});

test('entries of the legend stay once they were seen, in the order of the layers', () => {
  const entry = (text) => ({ text, shape: 'disc', colour: 0 });
  const first = kept(new Map(), [[], [entry('b')]]);
  const second = kept(first, [[entry('a')], []]);
  assert.deepEqual(
    [...second.values()].map(({ text }) => text),
    ['a', 'b'],
  );
});
