// Many <skel-drawing>s: what becomes of them when they come and go, of the browser's WebGL contexts, and of drawings that
// are asked for in other ways. `page`: an open examples/javascript/element.html (npm.mjs).
import assert from 'node:assert/strict';

const kContexts = 16; // that Chromium allows
const kPatience_ms = 20_000; // with a machine that has other things to do

export async function testElements(page, shots) {
  await page.evaluate(() => {
    document.querySelector('skel-drawing').remove();
    globalThis.added = (attributes) => {
      const element = Object.assign(document.createElement('skel-drawing'), attributes);
      element.style.cssText = 'width: 90px; height: 90px';
      document.body.append(element);
      return element;
    };
    globalThis.said = (element) => new Promise((resolve) => {
      element.addEventListener('rigged', () => resolve('rigged'), { once: true });
      element.addEventListener('error', ({ detail }) => resolve(`${detail.name}: ${detail.message}`), { once: true });
    });
    globalThis.shows = (element) => {
      const canvas = element.shadowRoot.querySelector('canvas');
      return canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.some((value) => value > 0);
    };
    // Once all that are to be drawn have been.
    globalThis.drawn = async () => { for (let i = 0; i < 3; ++i) await new Promise(requestAnimationFrame); };
    globalThis.gone = 0;
    globalThis.graves = new FinalizationRegistry(() => ++globalThis.gone);
  });

  // More of them than there are contexts.
  assert.equal(await page.evaluate(async (count) => {
    const elements = Array.from({ length: count }, () => added({ src: 'hero.png', clip: 'dance' }));
    await Promise.all(elements.map(said));
    await drawn();
    const shown = elements.filter(shows).length;
    scrollTo(0, 1e5);
    await new Promise((resolve) => setTimeout(resolve, 500));
    return shown;
  }, kContexts + 4) >= kContexts, true);
  await page.screenshot({ path: `${shots}/npm-elements.png` });
  assert.equal(await page.evaluate(() => [...document.querySelectorAll('skel-drawing')].filter(shows).length), kContexts + 4);

  // One stays, others come and go, with drawings and without: it goes on, and nothing is left of them.
  const protocol = await page.context().newCDPSession(page);
  await protocol.send('Performance.enable');
  const left = async () => {
    for (let i = 0; i < 3; ++i) {
      await protocol.send('HeapProfiler.collectGarbage');
      await page.waitForTimeout(100);
    }
    const { metrics } = await protocol.send('Performance.getMetrics');
    return ['Nodes', 'JSEventListeners'].map((name) => metrics.find((metric) => metric.name === name).value);
  };
  await page.evaluate(async () => {
    for (const element of document.querySelectorAll('skel-drawing')) element.remove();
    globalThis.kept = added({ src: 'hero.png', clip: 'dance' });
    await said(kept);
  });
  const before = await left();
  await page.evaluate(async (count) => {
    for (let i = 0; i < count; ++i) {
      const drawing = added({ src: 'hero.png', clip: 'dance' }), empty = added({});
      for (const element of [drawing, empty]) graves.register(element);
      await said(drawing);
      drawing.remove();
      empty.remove();
    }
  }, kContexts + 2);
  await page.waitForTimeout(500);
  const after = await left();
  const collected = await page.evaluate(() => gone); // the last two may still be spoken of
  assert.ok(collected >= 2 * (kContexts + 1), `${collected} are gone`);
  assert.ok(after.every((count, i) => count <= before[i] + 20), `nodes, listeners: ${before}, then ${after}`);
  const dances = () => page.evaluate(async (patience_ms) => {
    const canvas = kept.shadowRoot.querySelector('canvas'), first = canvas.toDataURL();
    const since = performance.now();
    while (canvas.toDataURL() === first && performance.now() - since < patience_ms) await new Promise((resolve) => setTimeout(resolve, 200));
    return shows(kept) && canvas.toDataURL() !== first;
  }, kPatience_ms);
  assert.ok(await dances());

  // Put back where it was, it dances again.
  await page.evaluate(() => kept.remove());
  await page.evaluate(() => document.body.append(kept));
  assert.ok(await dances());

  // A page that takes all contexts for itself: it is said, the picture stays; with the next drawing it dances again.
  assert.match(await page.evaluate(async (count) => {
    const complaint = said(kept);
    globalThis.others = Array.from({ length: count }, () => document.createElement('canvas').getContext('webgl2'));
    return complaint;
  }, kContexts + 4), /^Error: WebGL: the browser has taken the context away/);
  assert.ok(await page.evaluate(() => shows(kept)));
  assert.equal(await page.evaluate(async () => {
    for (const other of others) other.getExtension('WEBGL_lose_context')?.loseContext();
    const answer = said(kept);
    kept.src = 'hero.png?again';
    return answer;
  }), 'rigged');
  assert.ok(await dances());
  assert.equal(await page.evaluate(() => kept.shadowRoot.querySelector('[part=error]').textContent), '');

  // No drawing is none.
  for (const none of ["kept.src = ''", "kept.removeAttribute('src')"]) {
    assert.deepEqual(await page.evaluate(`(async () => {
      ${none};
      await drawn();
      const none = [shows(kept), kept.clips.length];
      kept.src = 'hero.png';
      await said(kept);
      await drawn();
      return [...none, shows(kept)];
    })()`), [false, 0, true], none);
  }
  assert.match(await page.evaluate(() => said(added({ src: 'javascript:1' }))), /^SkelError: javascript:1: cannot be loaded \(/);
}

// A drawing that the browser makes smaller takes a mask of its own size, and one of the size that it has then.
export async function testLargeMasks(page) {
  const found = await page.evaluate(async () => {
    const { rig } = await import('./node_modules/skel/browser.js');
    const picture = await createImageBitmap(await (await fetch('hero.png')).blob());
    const drawn = (size, work) => {
      const canvas = new OffscreenCanvas(size, size), context = canvas.getContext('2d');
      work(context);
      return canvas.convertToBlob({ type: 'image/png' });
    };
    const large = await drawn(4000, (context) => {
      context.fillStyle = 'white';
      context.fillRect(0, 0, 4000, 4000);
      context.drawImage(picture, 0, 0, 4000, 4000);
    });
    // Of the figure's middle, so that it is seen whether it is taken.
    const mask = (size) => drawn(size, (context) => {
      context.fillStyle = 'black';
      context.fillRect(0, 0, size, size);
      context.fillStyle = 'white';
      context.fillRect(size / 4, size / 8, size / 2, size * 3 / 4);
    });
    const results = [];
    for (const size of [4000, 2048, 600]) {
      try {
        const character = await rig(large, { name: 'large.png', mask: await mask(size) });
        results.push([character.scaled, character.width, character.mask.reduce((sum, value) => sum + (value > 0), 0)]);
      } catch ({ name, message }) {
        results.push(`${name}: ${message}`);
      }
    }
    return results;
  });
  assert.deepEqual(found, [[true, 2048, 1024 * 1536], [true, 2048, 1024 * 1536], 'SkelError: the mask: is a mask of 600x600 px, the image has 4000x4000']);
}
