// Behind the example's page: what Phaser has made of the sheet, as text in the page.
const timer = setInterval(() => {
  const scene = game.scene?.scenes[0], hero = scene?.hero;
  if (!hero) return;
  clearInterval(timer);
  const atlas = scene.cache.json.get('hero-atlas'), { frameTags: tags, slices } = atlas.meta;
  const [{ pivot, bounds }] = slices[0].keys;
  const whole = ({ frames }, { from, to }) => frames.length === to - from + 1;
  const good = {
    tags: tags.every((tag) => whole(scene.anims.get(tag.name), tag)),
    loops: tags.every(({ name }) => scene.anims.get(name).repeat === (name.startsWith('idle') ? -1 : 0)),
    shown: hero.frame.realWidth === bounds.w && !hero.frame.name.startsWith('__'),
    origin: hero.displayOriginX === pivot.x && hero.displayOriginY === pivot.y,
  };
  // Frames that are called by their numbers are what Phaser itself makes animations of.
  if (scene.textures.get('hero').has('0')) {
    scene.cache.json.add('hero', atlas); // as this.load.aseprite() does
    const made = scene.anims.createFromAseprite('hero', undefined, hero);
    good.aseprite = made.length === tags.length && made.every((one, i) => one.key === tags[i].name && whole(one, tags[i]));
  }
  document.body.textContent = `RESULT ${Object.values(good).every(Boolean) ? 'good' : 'WRONG'} ${JSON.stringify(good)}`;
}, 50);
