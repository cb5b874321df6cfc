"""Label files as a table, a row a candidate: labels_to_pandas.py FOLDER OUT.csv"""

import sys

import pandas as pd

import skel

folder, out = sys.argv[1:]
rows = [
    pd.DataFrame(
        {
            "character": character.name,
            "x": character.features[:, 0],
            "y": character.features[:, 1],
            "radius": character.features[:, 2],
            "class": [skel.CLASSES[label] for label in character.labels],
        }
    )
    for character in skel.LabelledSet.load(folder).characters
]
table = pd.concat(rows, ignore_index=True)
table.to_csv(out, index=False)
print(table.groupby("class")[["x", "y", "radius"]].mean().round(2))
print(f"{len(table)} candidates of {table['character'].nunique()} characters")
