# All tasks of a person or CI. Only cargo is needed, except for `strangers` and `strangers-more`, which install their own readers, for
# `wheel` and `python`, which need Python 3 and fetch the packages in python/requirements.txt from PyPI, and
# for `deny`, `audit`, `mutants` and `fuzz`, which print how to install their tools.

CARGO ?= cargo
# Lints and pages of the Python package are made without Python.
NO_PYTHON = PYO3_NO_PYTHON=1 PYO3_BUILD_EXTENSION_MODULE=1
# The program for CI. With the features that the Python package needs of shared dependencies, so that the wheel compiles none of them again.
RELEASE = $(CARGO) build --release --locked -p stargrip-cam -p stargrip-cam-python --bin stargrip-cam

.PHONY: demo install dist portable web site wheel python test check docs deny audit strangers strangers-more mutants fuzz faults bench

# Build the paper's star and print the files and their place.
demo:
	$(CARGO) run --release --locked -- build designs/paper-five-points.toml

# Program, completions, manual and examples below PREFIX: `make install PREFIX=~/.local`.
PREFIX ?= /usr/local
install:
	$(CARGO) build --release --locked
	packaging/lay-out target/release/stargrip-cam $(DESTDIR)$(PREFIX)

# The same as an archive, for TARGET if it is named. For Linux the program in it is static.
TARGET ?=
dist:
	packaging/dist $(TARGET)

# The program as a page (docs/web.md): index.html for a server and stargrip-cam.html for a disk, in target/web. Needs the target and Python 3.
WASM = wasm32-unknown-unknown
web:
	@test -d "$$(rustc --print sysroot)/lib/rustlib/$(WASM)" || { echo "a target is missing: run \`rustup target add $(WASM)\`" >&2; exit 1; }
	$(CARGO) build --locked --profile page -p stargrip-cam-web --target $(WASM)
	web/make-page target/$(WASM)/page/stargrip_cam_web.wasm target/web

# Book and page as one static site in target/site.
site: docs web
	web/make-site target/book target/web target/site

# The Python package (docs/python.md): the wheel in target/wheels; and that wheel in a virtual environment below target/, tested.
wheel:
	python/run wheel
python:
	python/run check

# Whether it compiles for Windows and macOS, as far as their standard libraries are here; TARGETS names others.
portable:
	packaging/portable $(TARGETS)

# The packages tested here; the Python package has tests of its own (`make python`).
TESTED = -p stargrip-cam -p inflatable -p drawings -p research
# Examples are compiled by the lints of `check`; a test that needs one has it as a module.
test:
	$(CARGO) test --locked --tests $(TESTED)
	$(CARGO) test --locked --doc $(TESTED)

# The first checks of CI: format, dependencies, lints, the tests in debug, the fuzz targets' lock file, the release program's files against
# those of the tests, the documentation.
check:
	$(CARGO) fmt --all --check
	$(MAKE) deny
	$(NO_PYTHON) $(CARGO) clippy --locked --workspace --all-targets -- -D warnings
	$(MAKE) test
	$(CARGO) tree --manifest-path fuzz/Cargo.toml --locked >/dev/null
	$(RELEASE)
	$(CARGO) test --locked --test golden -- --ignored
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --locked --no-deps --document-private-items $(TESTED)

# The pages of docs/ as a book, target/book/index.html. `make test` holds its list, links and pictures, so CI does not build it.
MDBOOK = $(shell PATH="$$PATH:target/ci-tools/bin" command -v mdbook)
docs:
	@test -n "$(MDBOOK)" || { echo "mdbook is missing: run \`cargo install --locked mdbook\`" >&2; exit 1; }
	$(MDBOOK) build
	@echo "open target/book/index.html"

# Licences, doubled versions and sources of all dependencies, by deny.toml. It uses no network and takes a second.
deny:
	@$(call needs,deny,cargo-deny)
	$(CARGO) deny --workspace --locked check licenses bans sources

# Known faults of the dependencies. Not in `check`: it reads a public list that changes, so it can fail on any day.
audit:
	@$(call needs,deny,cargo-deny)
	$(CARGO) deny --workspace --locked check advisories

# Mutants of some files, and those that no test notices (docs/testing.md): `make mutants FILES='src/plan/*.rs' SHARD=0/8`.
FILES ?= src/plan/*.rs
SHARD ?= 0/1
mutants:
	@$(call needs,mutants,cargo-mutants)
	mkdir -p target
	PROPTEST_RNG_SEED=20 INSTA_UPDATE=no $(CARGO) mutants -f '$(FILES)' --shard $(SHARD) -o target/mutants -- --locked --tests

# Every fuzz target for TIME seconds in turn, and the totals of all runs (docs/reliability.md): `make fuzz TIME=600 TARGETS='resume gcode'`.
TIME ?= 60
TARGETS ?=
fuzz:
	@$(call needs,fuzz,cargo-fuzz)
	fuzz/run $(TIME) $(TARGETS)

# Kills and errors at every system call of a publication, by strace (docs/reliability.md). Minutes.
faults:
	$(RELEASE)
	tests/faults/run target/release/stargrip-cam

# Prints how to install a missing cargo subcommand.
needs = $(CARGO) $(1) --version >/dev/null 2>&1 || { echo "$(2) is missing: run \`cargo install --locked $(2)\`" >&2; exit 1; }

# Readers of other authors, on every output of every shipped design. Needs root for apt-get.
strangers:
	$(RELEASE)
	tests/strangers/run

# Larger programs on some designs, before a release: FreeCAD, PrusaSlicer, OctoPrint's analysis, a CUPS filter (docs/testing.md).
strangers-more:
	$(RELEASE)
	tests/strangers/more

bench:
	$(CARGO) bench --locked
