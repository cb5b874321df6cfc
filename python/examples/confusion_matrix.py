"""How the built-in net mistakes classes, as a picture: confusion_matrix.py FOLDER OUT.png"""

import sys

import matplotlib.pyplot as plt

import skel

folder, out = sys.argv[1:]
evaluation = skel.evaluate(skel.Net.builtin(), skel.LabelledSet.load(folder))
shares = evaluation.confusion / evaluation.confusion.sum(axis=1, keepdims=True)

figure, axes = plt.subplots(figsize=(5, 4))
image = axes.imshow(shares, cmap="Blues", vmin=0, vmax=1)
axes.set_xticks(range(4), skel.CLASSES)
axes.set_yticks(range(4), skel.CLASSES)
axes.set_xlabel("by the net")
axes.set_ylabel("by hand")
for row in range(4):
    for column in range(4):
        axes.text(column, row, f"{shares[row, column]:.2f}", ha="center", va="center", color="white" if shares[row, column] > 0.5 else "black")
axes.set_title(f"accuracy {evaluation.accuracy:.3f}")
figure.colorbar(image)
figure.tight_layout()
figure.savefig(out, dpi=120, format="png")
print(f"accuracy {evaluation.accuracy:.3f}, balanced {evaluation.balanced_accuracy:.3f}")
