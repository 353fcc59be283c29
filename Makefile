# Two commands to begin with: `make run` and `make test`. Needs Rust (rustup, stable) and a C compiler; a cmake new
# enough for the bundled HDF5 is looked for, or put under .tools, by .ci/provide-cmake.

STUDY  ?= configs/europe.toml
# A third of the strengths, so that the first look takes about a minute; `make run SET=` runs the study as it stands.
SET    ?= --set strengths.values=0:1/100:1
NAME   := $(basename $(notdir $(STUDY)))
OUTPUT ?= results/$(if $(SET),$(patsubst europe-%,%,$(NAME)-first-look),$(NAME)).h5

TOOLS := $(shell .ci/provide-cmake)
ifeq ($(TOOLS),)
$(error cmake 3.26 or newer is needed: see the lines above)
endif
ORIGINAL_PATH := $(PATH)
export PATH := $(TOOLS):$(PATH)

UPLIFT := target/release/uplift

# Tests are built without incremental compilation, a tenth less, until cargo has once been called without make: whoever
# does that goes on with it.
ifeq ($(wildcard $(or $(CARGO_TARGET_DIR),$(CARGO_BUILD_TARGET_DIR),target)/debug/incremental/*),)
export CARGO_INCREMENTAL ?= 0
endif

.PHONY: run build install wheel dist test tests-built test-long check test-cluster torture doc-figures doc-outputs \
	lint docs book web python sbom notices bench coverage fuzz clean

run: build
	$(UPLIFT) run $(STUDY) $(SET) -o $(OUTPUT)
	$(UPLIFT) bootstrap $(OUTPUT) --quiet > /dev/null
	@echo "Report, with every figure: open"
	@$(UPLIFT) report $(OUTPUT)

build:
	cargo build --release --locked --package uplift-cli

# The program, its manual (`man uplift-run`) and completions of bash, zsh and fish.
PREFIX ?= $(HOME)/.local

install: build
	install -d "$(PREFIX)/bin"
	install -m 755 $(UPLIFT) "$(PREFIX)/bin/uplift"
	$(UPLIFT) manual "$(PREFIX)/share"
	@case ":$(ORIGINAL_PATH):" in *":$(PREFIX)/bin:"*) echo "installed: uplift --help" ;; \
		*) echo "installed in $(PREFIX)/bin, which is not on your PATH: add it there, or make install PREFIX=..." ;; esac

# The figures of the documents that take minutes, written anew where they differ; needs real records
# (docs/contributing.md).
doc-figures:
	UPDATE_DOCS=1 cargo test --locked --workspace --test end_to_end figures:: -- --include-ignored

# What the documents show of commands, written anew where it differs.
doc-outputs: build
	tests/outputs --program $(UPLIFT) --update

# Crates, the built program, its result file from Python; the packages for that arrive while the tests are compiled.
test:
	@$(MAKE) --no-print-directory --jobs python tests-built
	cargo test --locked --workspace --tests

tests-built:
	cargo test --locked --workspace --tests --no-run

# The tests of the built program that take two seconds and more, longer than all others together.
LONG_TESTS = $(shell grep -rhA1 'ignore = "long' tests | sed -n 's/^.*fn \([a-z0-9_]*\).*/\1/p')

test-long: python
	cargo test --locked --workspace --test end_to_end -- --ignored \
		$(or $(LONG_TESTS),$(error no test is marked `#[ignore = "long: make test-long"]` right above its `fn`))

# What CI asks of a change: every test, and formatting, lints and documentation besides.
check: lint docs book test test-long

# The Python package: its wheel in python/dist, with the program in it, installed into a fresh environment and tested
# there (docs/python.md).
wheel: build
	.ci/build-wheel $(UPLIFT)

# What a release page holds, in dist: wheel, source distribution, archive of the program, bill of materials, sums.
# PORTABLE=2.17 on Linux: program and wheel need that glibc and no newer one, since zig links them against its own copy.
# It builds the program for aarch64 as well (cargo zigbuild --target aarch64-unknown-linux-gnu.2.17), never run so far.
HOST := $(shell rustc -vV | sed -n 's/^host: //p')
PORTABLE ?=

ifeq ($(PORTABLE),)
dist: wheel
	.ci/build-distribution $(UPLIFT)
else
dist:
	PATH="$$(.ci/provide-zig):$$PATH" \
		cargo zigbuild --release --locked --package uplift-cli --target $(HOST).$(PORTABLE)
	.ci/check-glibc $(PORTABLE) target/$(HOST)/release/uplift
	PORTABLE=$(PORTABLE) .ci/build-wheel target/$(HOST)/release/uplift
	.ci/build-distribution target/$(HOST)/release/uplift
endif

# The engines of docs/cluster for real: Slurm and HyperQueue, as far as they can be had here.
test-cluster: build
	tests/cluster/run.sh

# Damaged files, full disks, kills and races by the hundred, see docs/testing.md.
torture:
	cargo test --locked --workspace --test end_to_end torture -- --ignored --nocapture

lint:
	.ci/check-line-width
	.ci/check-paths
	tests/words
	.ci/check-dependencies
	cargo fmt --all --check
	cargo fmt --manifest-path python/Cargo.toml --check
	cargo fmt --manifest-path web/Cargo.toml --check
	cargo clippy --locked --workspace --all-targets -- -D warnings

# Documentation of the code, without warnings; every example in it runs.
docs:
	RUSTDOCFLAGS="-D warnings" cargo doc --locked --workspace --no-deps
	env -u MAKEFLAGS -u MFLAGS cargo test --locked --workspace --doc  # examples cannot reach make's job server, and warn

# The documents as one searchable book, target/book/index.html: no warning, no broken link, nothing from other hosts.
book:
	.ci/build-book

# The calculator in the browser, web/dist/index.html (docs/browser.md), by the program of `make build` or another one:
# `make web UPLIFT=target/debug/uplift`.
web:
	@[ -x $(UPLIFT) ] || $(MAKE) --no-print-directory build
	web/build $(UPLIFT)

# Python reads the result files in the tests; without it those tests say that they were skipped.
python:
	.ci/provide-python

# What the program is built from, for those who hand it on: a bill of materials, and every notice.
sbom:
	@mkdir -p target
	.ci/check-dependencies sbom > target/uplift.cdx.json
	@echo target/uplift.cdx.json

notices:
	@mkdir -p target
	.ci/check-dependencies notices > target/THIRD-PARTY-NOTICES.txt
	@echo target/THIRD-PARTY-NOTICES.txt

bench: python
	cargo bench --locked -p uplift-oscillator --bench solvers
	cargo bench --locked -p uplift-ida --bench chapter_4
	cargo bench --locked -p uplift-bootstrap --bench resampling
	cargo bench --locked -p uplift-block --bench block
	cargo bench --locked -p uplift-frame --bench frame
	.venv/bin/python crates/frame/benches/dop853.py
	cargo bench --locked -p uplift-consistency --bench repair

# How often bands hold what they are bands of, some minutes; SETS=1000 for figures to print (docs/confidence-bands.md);
# PARTS="values earthquakes" for some of the parts, of records, values, lognormal, earthquakes.
SETS ?= 200

coverage:
	cargo run --release --locked --package uplift --example coverage $(SETS) $(PARTS)

# Every reader of files from outside against what libFuzzer makes of the samples, TIME seconds each (docs/testing.md);
# one of them by its crate and name: `make fuzz FUZZ=motion/at2 TIME=600`.
TIME ?= 60
FUZZ ?= $(subst /fuzz/fuzz_targets,,$(patsubst crates/%.rs,%,$(wildcard crates/*/fuzz/fuzz_targets/*.rs)))

fuzz: $(addprefix fuzz/,$(FUZZ))

# The crates that are fuzzed have no unsafe code, so no sanitizer is needed, and stable Rust will do.
fuzz/%:
	@cargo fuzz --version > /dev/null 2>&1 || \
		{ echo "cargo-fuzz is needed: cargo install --locked cargo-fuzz" >&2; exit 1; }
	mkdir -p crates/$(*D)/fuzz/corpus/$(*F)
	cd crates/$(*D) && cargo fuzz run --sanitizer none $(*F) fuzz/corpus/$(*F) tests/samples -- \
		-dict=fuzz/words.dict -max_len=65536 -rss_limit_mb=512 -timeout=5 -max_total_time=$(TIME) -print_final_stats=1

clean:
	cargo clean
	rm -rf .venv .tools results dist crates/*/fuzz/target python/target python/dist python/uplift_urs._native.data
	rm -rf web/target web/dist
