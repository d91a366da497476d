// SPDX-License-Identifier: Apache-2.0
// The scene in a browser, on scenarios of every kind. Its pictures are to be looked at.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { openPage, startBrowser, startLab } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

/** Waits until a function of the page gives something; the policy forbids page.waitForFunction. */
async function until(page, holds, seconds = 120) {
  for (const end = Date.now() + 1000 * seconds; Date.now() < end; ) {
    if (await page.evaluate(holds)) return;
    await page.waitForTimeout(50);
  }
  assert.fail(`never: ${holds}`);
}

/** Opens a scenario and plays it until `t` [s]. */
async function playTo(run, file, t, { speed = 0, size } = {}) {
  const lab = await startLab(file);
  run.after(() => lab.process.kill('SIGKILL'));
  const lookedAt = await openPage(browser, lab.url, size);
  const { page } = lookedAt;
  await until(page, () => window.microswarm?.scene.pictures > 0);
  await page.evaluate(
    ([speed, t]) => {
      const { connection, scene } = window.microswarm;
      window.touches = [];
      scene.onTouch((touch) => window.touches.push(touch));
      void connection.ask({ do: 'speed', number: speed });
      void connection.ask({ do: 'play' });
      connection.listen((message) => {
        if (message.type !== 'frame' || message.frame.t_s < t || window.reached) return;
        window.reached = true;
        void connection.ask({ do: 'pause' });
      });
    },
    [speed, t],
  );
  await until(page, () => window.reached);
  const handle = await page.evaluateHandle(() => window.microswarm.scene);
  await page.waitForTimeout(300);
  return {
    ...lookedAt,
    lab,
    scene: (work, argument) => handle.evaluate(work, argument),
    end: async () => {
      await lookedAt.close();
      assert.equal(await lab.stop(), 0);
    },
  };
}

const names = (scene) => scene.layers().map(({ name }) => name);

test('radar among twelve obstacles', async (t) => {
  const run = await playTo(t, 'scenarios/papers/radar/twelve.yaml', 38, { speed: 20 });
  await run.picture('scene-radar');
  await run.scene((scene) => scene.follow(true));
  await run.scene((scene) => scene.zoomBy(6));
  await run.page.waitForTimeout(200);
  await run.picture('scene-radar-close');
  await run.scene((scene) => scene.setTheme('dark'));
  await run.page.waitForTimeout(200);
  await run.picture('scene-radar-dark');
  await run.end();
});

test('robots gather; regions and clearance', async (t) => {
  const run = await playTo(t, 'scenarios/papers/gather/vascular_network.yaml', 20);
  await run.picture('scene-gather');
  await run.scene((scene) => scene.show('aggregation', false));
  await run.scene((scene) => scene.show('clearance', true));
  await run.page.waitForTimeout(600);
  await run.picture('scene-clearance');
  await run.end();
});

test('a deforming channel', async (t) => {
  const run = await playTo(t, 'scenarios/papers/drrt/deforming_channel.yaml', 12, { speed: 20 });
  await run.picture('scene-channel');
  await run.end();
});

test('valves', async (t) => {
  const run = await playTo(t, 'scenarios/papers/radar/micromaze.yaml', 70, { speed: 20 });
  await run.scene((scene) => scene.show('obstacle-trails', true));
  await run.page.waitForTimeout(200);
  await run.picture('scene-valves');
  await run.end();
});

test('a retina', async (t) => {
  const run = await playTo(t, 'scenarios/demo.yaml', 20, { speed: 20 });
  await run.picture('scene-retina');
  await run.scene((scene) => scene.follow(true));
  await run.scene((scene) => scene.zoomBy(15));
  await run.page.waitForTimeout(300);
  await run.picture('scene-retina-close');
  await run.end();
});
