"""Draws the picture of the README from a result file: python urs.py results/europe.h5 urs.png.

Needs h5py and matplotlib.
"""

import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

result, picture = sys.argv[1:]
with h5py.File(result) as file:
    u_m = file["urs/pgv/u_m"][:]
    sites = list(file["axes/site"].asstr()[:])
    strengths = file["axes/strength"][:]
    poe = list(file["axes/poe"][:]).index(0.02)
    synthetic = bool(file.attrs["synthetic"])

# Okabe and Ito's colours, told apart by the colour-blind; line styles tell them apart in grey
styles = zip(["#000000", "#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00"], ["-", "-", "--", "--", "-.", ":"])
figure, axes = plt.subplots(figsize=(7.0, 3.6), layout="constrained")
order = sorted(range(len(sites)), key=lambda site: -u_m[site, poe].max())
for site, (colour, line) in zip(order, styles):
    axes.plot(strengths, u_m[site, poe], line, color=colour, label=sites[site], linewidth=1.6)
axes.set_xlabel(r"uplift strength $f_\mathrm{up}/(mg)$")
axes.set_ylabel("displacement demand, m")
axes.set_xlim(0, 1)
axes.set_ylim(0, None)
axes.grid(alpha=0.3)
axes.legend(title="2 % in 50 years, by PGV", frameon=False)
if synthetic:
    axes.text(0.99, 0.03, "synthetic records", transform=axes.transAxes, ha="right", color="#555555", style="italic")
figure.savefig(picture, dpi=150)
