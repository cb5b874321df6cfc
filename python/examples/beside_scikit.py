"""Our net of 3-4-4-2 beside a forest of scikit-learn, on characters left out of training: beside_scikit.py FOLDER OUT.txt"""

import sys

import numpy as np
from sklearn.ensemble import RandomForestClassifier
from sklearn.model_selection import GroupKFold, cross_val_score

import skel

folder, out = sys.argv[1:]
characters = skel.LabelledSet.load(folder)
features = np.concatenate([c.features for c in characters.characters])
labels = np.concatenate([c.labels for c in characters.characters])
groups = np.repeat(np.arange(len(characters)), [len(c.labels) for c in characters.characters])

forest = RandomForestClassifier(n_estimators=60, min_samples_leaf=5, random_state=1)
scores = cross_val_score(forest, features, labels, groups=groups, cv=GroupKFold(5))
ours = skel.train(characters, folds=5, epochs=100, restarts=1, generated=0).evaluation
assert ours is not None
text = f"forest of scikit-learn {scores.mean():.3f}, our net {ours.accuracy:.3f}, on characters left out of training (5 folds)\n"
with open(out, "w") as file:
    file.write(text)
print(text, end="")
