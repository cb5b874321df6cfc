// Every word of the page. Another language is another column; what the core says stays as the tools say it.
const words = {
  tagline: ['Your drawing comes to life. It never leaves this device.', 'Deine Zeichnung wird lebendig. Sie verlässt dieses Gerät nie.'],
  language: ['Language', 'Sprache'],
  stepDrawing: ['1 · Choose a drawing', '1 · Zeichnung wählen'],
  drop: ['Drop a drawing here', 'Zeichnung hierher ziehen'],
  dropMore: ['several at once are fine, and so is a saved skeleton', 'gern mehrere auf einmal, oder ein gespeichertes Skelett'],
  chooseFile: ['Choose a file', 'Datei wählen'],
  takePhoto: ['Take a photo', 'Foto machen'],
  orSample: ['or try one of ours', 'oder eine von uns'],
  sampleBiscuit: ['A gingerbread man', 'Ein Lebkuchenmann'],
  sampleRobot: ['A robot', 'Ein Roboter'],
  sampleFox: ['A fox', 'Ein Fuchs'],
  stepSkeleton: ['2 · Look at the skeleton', '2 · Skelett ansehen'],
  stageHelp: ['Drag a joint that is in the wrong place; “Add” and “Erase” change the figure itself. With the keyboard: Tab to a joint, move it with the arrow keys.',
    'Zieh ein Gelenk, das falsch sitzt; „Ergänzen“ und „Radieren“ ändern die Figur selbst. Mit der Tastatur: Tab bis zum Gelenk, dann die Pfeiltasten.'],
  toolJoints: ['Joints', 'Gelenke'],
  toolAdd: ['Add', 'Ergänzen'],
  toolErase: ['Erase', 'Radieren'],
  brushSize: ['Brush', 'Pinsel'],
  undo: ['Undo', 'Rückgängig'],
  redo: ['Redo', 'Wiederholen'],
  again: ['Reset', 'Von vorn'],
  bodyPlan: ['Body', 'Körper'],
  planAuto: ['choose for me', 'selbst wählen'],
  planBiped: ['two legs', 'zwei Beine'],
  planQuadruped: ['four legs', 'vier Beine'],
  figure: ['Figure', 'Figur'],
  confidence: ['Sure to {0} %', 'Zu {0} % sicher'],
  stepModel: ['3 · Watch it move', '3 · Bewegung ansehen'],
  modelLabel: ['The model. Arrow keys turn it.', 'Das Modell. Pfeiltasten drehen es.'],
  motion: ['Motion', 'Bewegung'],
  look: ['Look', 'Aussehen'],
  lookSolid: ['model', 'Modell'],
  lookFlat: ['drawing', 'Zeichnung'],
  cutting: ['Cutting out the drawing …', 'Zeichnung wird ausgeschnitten …'],
  rest: ['stand still', 'stillstehen'],
  play: ['Play', 'Abspielen'],
  pause: ['Pause', 'Anhalten'],
  turn: ['Turn', 'Drehen'],
  noWebgl: ['This browser shows no 3D here. The skeleton can be mended and saved all the same.',
    'Dieser Browser zeigt hier kein 3D. Das Skelett lässt sich trotzdem bearbeiten und speichern.'],
  stepSave: ['4 · Save', '4 · Speichern'],
  saveGlb: ['Model', 'Modell'],
  saveGlbHint: ['GLB, for games and 3D programs', 'GLB, für Spiele und 3D-Programme'],
  saveFilm: ['Film', 'Film'],
  saveFilmHint: ['the chosen motion, as video', 'die gewählte Bewegung, als Video'],
  saveSheet: ['Sprite sheet', 'Spritesheet'],
  saveSheetHint: ['24 pictures in one PNG', '24 Bilder in einem PNG'],
  saveFrames: ['Pictures', 'Einzelbilder'],
  saveFramesHint: ['PNG frames in a ZIP', 'PNG-Bilder in einem ZIP'],
  saveSkeleton: ['Skeleton', 'Skelett'],
  saveSkeletonHint: ['to go on later, here or in the tools', 'zum Weitermachen, hier oder in den Programmen'],
  saveTexture: ['Colours', 'Farben'],
  saveTextureHint: ['the texture, as PNG', 'die Textur, als PNG'],
  saveAll: ['Save all as ZIP', 'Alle als ZIP speichern'],
  many: ['Your drawings', 'Deine Zeichnungen'],
  manyProgress: ['{0} of {1} drawings', '{0} von {1} Zeichnungen'],
  starting: ['Getting ready …', 'Gleich geht es los …'],
  reading: ['Reading the drawing …', 'Zeichnung wird gelesen …'],
  rigging: ['Finding the figure and its joints …', 'Figur und Gelenke werden gesucht …'],
  modelling: ['Building the model …', 'Modell wird gebaut …'],
  filming: ['Filming …', 'Film wird aufgenommen …'],
  drawingFrames: ['Drawing pictures …', 'Bilder werden gezeichnet …'],
  ready: ['Ready.', 'Fertig.'],
  saved: ['Saved: {0}', 'Gespeichert: {0}'],
  scaled: ['The picture is large: it was made smaller, to {0} × {1} px.', 'Das Bild ist groß: Es wurde auf {0} × {1} px verkleinert.'],
  needsDrawing: ['{0}: drop the drawing that it belongs to, too', '{0}: dazu gehört eine Zeichnung, bitte auch hierher ziehen'],
  needsMask: ['{0}: was made with the mask {1}; drop it together with the drawing', '{0}: gehört zur Maske {1}; bitte zusammen mit der Zeichnung hierher ziehen'],
  noFilm: ['This browser records no films.', 'Dieser Browser kann keine Filme aufnehmen.'],
  tooOld: ['This browser is too old for skel. Firefox 105, Chrome 95, Safari 16.4 or newer will do.',
    'Dieser Browser ist zu alt für skel. Es geht mit Firefox 105, Chrome 95, Safari 16.4 oder neuer.'],
  crashed: ['Something went wrong ({0}). The page has started anew: try again.', 'Etwas ging schief ({0}). Die Seite hat neu angesetzt: Versuch es noch einmal.'],
  about: ['About', 'Über skel'],
  aboutText: ['skel turns one drawing into a rigged, animated 3D character. Everything happens on this device; nothing is sent anywhere.',
    'skel macht aus einer Zeichnung eine bewegliche 3D-Figur. Alles geschieht auf diesem Gerät; nichts wird verschickt.'],
  credits: ['With thanks to', 'Mit Dank an'],
  jointLabel: ['{0}, {1} % sure', '{0}, zu {1} % sicher'],
  clip_idle: ['idle', 'warten'], clip_walk: ['walk', 'gehen'], clip_run: ['run', 'rennen'], clip_jump: ['jump', 'hüpfen'],
  clip_wave: ['wave', 'winken'], clip_dance: ['dance', 'tanzen'], clip_sit: ['sit', 'sitzen'], clip_cheer: ['cheer', 'jubeln'],
  clip_greet: ['greet', 'verbeugen'], clip_talk: ['talk', 'reden'],
  clip_gallop: ['gallop', 'galoppieren'], clip_graze: ['graze', 'grasen'], clip_nod: ['nod', 'nicken'], clip_wag: ['wag', 'wedeln'],
};

export const languages = [['en', 'English'], ['de', 'Deutsch']];
let column = 0;

export function useLanguage(code) {
  column = Math.max(0, languages.findIndex(([known]) => known === code));
  document.documentElement.lang = languages[column][0];
  for (const element of document.querySelectorAll('[data-word]')) element.textContent = say(element.dataset.word);
  for (const element of document.querySelectorAll('[data-label]')) element.setAttribute('aria-label', say(element.dataset.label));
}

export const hasWord = (key) => key in words;

export function say(key, ...values) {
  return words[key][column].replace(/\{(\d)\}/g, (_, i) => values[i]);
}
