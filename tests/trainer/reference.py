#!/usr/bin/env python3
"""Reference numbers for the back-propagation test, by NumPy in double precision: writes reference.json beside itself.

The net is 3-4-4-2; every sigmoid and every derivative is written out here independently of skel's code.
"""
import json
import pathlib

import numpy as np

rng = np.random.default_rng(20181)
sizes = [3, 4, 4, 2]
weights = [rng.uniform(-2, 2, (o, i)) for i, o in zip(sizes, sizes[1:])]
biases = [rng.uniform(-1, 1, o) for o in sizes[1:]]
inputs = rng.uniform(0, 1, (70, 3)).astype(np.float32)
targets = rng.integers(0, 2, (70, 2)).astype(np.float32)
importance = rng.uniform(0.5, 2, 70).astype(np.float32)

x = inputs.astype(float)
layers = [x]
for w, b in zip(weights, biases):
    layers.append(1 / (1 + np.exp(-(layers[-1] @ w.T + b))))
scale = importance.astype(float)[:, None] / (importance.astype(float).sum() * sizes[-1])
error = layers[-1] - targets
loss = float((scale * error**2).sum())

gradients = []
delta = 2 * scale * error * layers[-1] * (1 - layers[-1])
for k in range(len(weights) - 1, -1, -1):
    gradients.insert(0, (delta.T @ layers[k], delta.sum(axis=0)))
    delta = (delta @ weights[k]) * layers[k] * (1 - layers[k])

# As skel keeps them: layer after layer, weights column by column, then biases.
flat = lambda pairs: [float(v) for w, b in pairs for v in (*w.flatten(order="F"), *b)]
rows = lambda a: [[float(v) for v in row] for row in a]
pathlib.Path(__file__).with_name("reference.json").write_text(json.dumps({
    "sizes": sizes,
    "parameters": flat(zip(weights, biases)),
    "inputs": rows(inputs),
    "targets": rows(targets),
    "weights": [float(v) for v in importance],
    "loss": loss,
    "gradient": flat(gradients),
}, indent=1) + "\n")
