# The verbs of this repository; `make` alone lists them. Everything they need is set up on the way.
SHELL := /bin/bash
.DEFAULT_GOAL := help
.PHONY: help demo lecture test lint bench fuzz stress agreement docs gallery wheel setup clean

VENV := .venv
RIVALS := .venv-bench
BIN := $(VENV)/bin
PYO3 := PYO3_PYTHON=$(CURDIR)/$(BIN)/python
CARGO_ALL := --locked --profile demo
SOURCES := pyproject.toml constraints.txt Cargo.toml Cargo.lock $(shell find crates -name '*.rs' -o -name Cargo.toml)

help: ## this list
	@grep -hE '^[a-z]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):.*## /  make \1\t/' | expand -t 18

demo: $(VENV)/.ok ## render a first picture
	@mkdir -p pictures
	@$(BIN)/antumbra render antumbra -o pictures/antumbra.png

lecture: $(VENV)/.ok ## render the whole lecture at full size as lecture/index.html, one file (QUICK=--quick: coarse)
	@$(BIN)/antumbra lecture --single-file -o lecture $(QUICK)

test: $(VENV)/.dev ## every test, Rust and Python
	@tools/run_tests.sh

lint: $(VENV)/.dev ## form, types and lints of both languages
	cargo fmt --check
	$(PYO3) cargo clippy $(CARGO_ALL) --workspace --all-targets --features pyo3/extension-module -- -D warnings
	@if [ -d "$$(rustc --print target-libdir --target wasm32-unknown-unknown 2>/dev/null)" ]; then \
	  cargo check $(CARGO_ALL) --target wasm32-unknown-unknown --no-default-features -p antumbra-math -p antumbra-trace -p antumbra; \
	else echo "note: no Rust target wasm32-unknown-unknown (rustup target add it): the core was not checked for it" >&2; fi
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/python -m mypy.stubtest antumbra._core
	$(BIN)/python tools/third_party.py --check
	$(BIN)/python tools/reference.py --check

fuzz: ## random input for every reader, found by coverage (SECONDS=300 each, two at a time)
	@tools/fuzz.sh $(or $(SECONDS),300)

stress: $(VENV)/.dev ## the tests at full size (10⁸ rays), and half an hour of random input for every reader (long)
	@ANTUMBRA_STRESS=1 tools/run_tests.sh
	@tools/fuzz.sh 1800

bench: $(RIVALS)/.ok ## measure speed: kernels, then races against other programs (RACE=--quick: small sizes)
	@tools/run_benches.sh $(RACE)

agreement: $(VENV)/.ok ## our pictures beside another renderer's references, as docs/agreement (QUICK=--quick: a look)
	@$(BIN)/python tools/agreement $(QUICK)

docs: $(VENV)/.ok ## write the reference pages that are made from the source
	$(BIN)/python tools/reference.py
	$(BIN)/python tools/equations.py

gallery: $(VENV)/.ok ## render the pictures of docs/gallery.md: built-in scenes, and the glTF assets of the test data
	$(BIN)/python tools/gallery.py --page
	$(BIN)/python tools/gallery.py

wheel: ## a wheel for other machines, in dist/ (WHEEL=quick: for this one, from what is built already)
	@tools/wheel.sh $(WHEEL)

setup: $(VENV)/.dev ## the environment alone

clean: ## remove everything that was built
	rm -rf $(VENV) $(RIVALS) .venv-wheel target dist python/antumbra/*.so

$(VENV)/.ok: $(SOURCES)
	@tools/setup.sh $(VENV) .
	@touch $@

# The programs that the races run against, in an environment of their own.
$(RIVALS)/.ok: $(SOURCES) benches/requirements.txt
	@MATURIN_PEP517_ARGS="--profile release" tools/setup.sh $(RIVALS) .
	@$(RIVALS)/bin/pip install --quiet --disable-pip-version-check -c constraints.txt -r benches/requirements.txt
	@touch $@

$(VENV)/.dev: $(SOURCES)
	@tools/setup.sh $(VENV) '.[dev]'
	@touch $(VENV)/.ok $@
