// SPDX-License-Identifier: Apache-2.0
// node bench.mjs [--quick]: times of the page in Chromium, as rows of `microswarm bench lab` in JSON.
import { join } from 'node:path';
import { drawRobots, openPage, root, startBrowser, startLab } from './tests/lab.mjs';

const quick = process.argv.includes('--quick');
const browser = await startBrowser();
const rows = [];

const quantile = (values, share) =>
  values.sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(share * values.length))];

/** What the browser draws with, as a part of rows' names; nothing for a graphics card. */
async function renderer() {
  const page = await browser.newPage();
  const name = await page.evaluate(() => {
    const gl = document.createElement('canvas').getContext('webgl2');
    const info = gl?.getExtension('WEBGL_debug_renderer_info');
    return info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  });
  await page.close();
  return /swiftshader|llvmpipe|software/i.test(name) ? ', software rendering' : '';
}

/** Opens a scenario; its page once there is a picture of it. */
async function open(file) {
  const began = performance.now();
  const lab = await startLab(join(root, file));
  const at = await openPage(browser, lab.url);
  await at.page.waitForSelector('.scene canvas');
  await at.page.evaluate(async () => {
    const isDrawn = () => window.microswarm?.scene.pictures > 0 && window.microswarm.connection.standing;
    while (!isDrawn()) await new Promise((resolve) => requestAnimationFrame(resolve));
  });
  return { ...at, lab, took: performance.now() - began };
}

async function end({ page, lab }) {
  await page.context().close();
  await lab.stop();
}

async function firstPicture() {
  const times = [];
  for (let i = 0; i < (quick ? 2 : 7); ++i) {
    const run = await open('scenarios/papers/radar/twelve.yaml');
    times.push(run.took);
    await end(run);
  }
  rows.push({
    name: `page${by}`,
    quantity: 'start of the program to the first picture, median',
    unit: 'ms',
    ours: quantile(times, 0.5),
    aim: 1000,
  });
}

/** From a change in the page to the picture that has it, while the session plays. */
async function changedPicture() {
  const run = await open('scenarios/papers/radar/twelve.yaml');
  const times = await run.page.evaluate(
    async (changes) => {
      const { connection, scene } = window.microswarm;
      const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
      const goal = () => JSON.stringify(scene.goal.places[0].at);
      await connection.ask({ do: 'play' });
      const times = [];
      for (let k = 0; k < changes; ++k) {
        await new Promise((resolve) => setTimeout(resolve, 20 + 30 * Math.random()));
        const before = goal();
        const began = performance.now();
        void connection.ask({ do: 'set', key: 'goal_um', value: `[${4000 + 10 * (k % 2)}, 1200]` });
        while (goal() === before) await frame();
        const { pictures } = scene;
        while (scene.pictures === pictures) await frame();
        times.push(performance.now() - began);
      }
      return times;
    },
    quick ? 40 : 200,
  );
  await end(run);
  rows.push({
    name: `page${by}`,
    quantity: 'change to its picture, p99',
    unit: 'ms',
    ours: quantile(times, 0.99),
    aim: 100,
  });
}

/** Pictures of as many robots as fast as they are drawn. */
async function manyRobots(count) {
  const run = await open('scenarios/papers/gather/t_junction.yaml');
  const rate = await drawRobots(run.page, count, quick ? 3 : 10);
  await end(run);
  const row = { name: `page${by}, ${count} robots`, quantity: 'pictures a second', unit: '1/s', ours: rate };
  rows.push(by ? row : { ...row, aim: 60, at_most: false });
}

const by = await renderer();
try {
  await firstPicture();
  await changedPicture();
  for (const count of [1000, 10_000]) await manyRobots(count);
} finally {
  await browser.close();
}
console.log(JSON.stringify(rows));
