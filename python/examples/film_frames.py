"""A film frame by frame, with the path of a hand in it: film_frames.py DRAWING CLIP FOLDER"""

import pathlib
import sys

import matplotlib.image
import numpy as np

import skel

drawing, clip, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
folder.mkdir(parents=True, exist_ok=True)
hero = skel.rig(drawing)
film = hero.film(clip, fps=12, size=(256, 256), background="none")
hand = [joint.name for joint in hero.joints].index("left_hand")
path = []
for number, frame in enumerate(film):
    matplotlib.image.imsave(folder / f"{number:04}.png", frame)
    path.append(hero.joint_positions(hero.pose(clip, number / film.fps))[hand])
way = np.linalg.norm(np.diff(path, axis=0), axis=1).sum()
print(f"{len(film)} frames; the left hand moves {way:.2f} m")
