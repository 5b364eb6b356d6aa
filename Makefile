# All tasks of developers and CI. They need cargo only, with these exceptions: `strangers` and `strangers-more` install their own readers;
# `wheel` and `python` need Python 3 and fetch the packages in python/requirements.txt from PyPI;
# `deny`, `audit`, `mutants` and `fuzz` print what to install.

CARGO ?= cargo
# Lints and documentation of the Python package need no Python.
NO_PYTHON = PYO3_NO_PYTHON=1 PYO3_BUILD_EXTENSION_MODULE=1
# The release program for CI, built with the Python package's features, so that the wheel does not compile shared dependencies again.
RELEASE = $(CARGO) build --release --locked -p stargrip-cam -p stargrip-cam-python --bin stargrip-cam

.PHONY: demo program install dist release release-check release-twice portable web site wheel python test check docs deny audit strangers strangers-more mutants fuzz faults bench

# Builds the paper's star and prints the files that were written.
demo:
	$(CARGO) run --release --locked -- build designs/paper-five-points.toml

# What CI tests, and the wheel packs.
program:
	$(RELEASE)

# Program, completions, manual and examples below PREFIX: `make install PREFIX=~/.local`.
PREFIX ?= /usr/local
install:
	STARGRIP_COMMIT=$$(packaging/commit) $(CARGO) build --release --locked
	packaging/lay-out target/release/stargrip-cam $(DESTDIR)$(PREFIX)

# The same as an archive, for TARGET if it is named. For Linux the program in it is static.
TARGET ?=
dist:
	packaging/dist $(TARGET)

# A release (docs/packaging.md): all archives, packages, wheels, SBOM and sums in target/dist, five minutes of a processor each. It installs
# its tools: Debian's packages by apt-get, wheels, crates, standard libraries. `release-check` uses them all, in minutes; `release-twice` builds the
# archives again elsewhere as another user, or that of TARGET alone, and compares them.
release:
	packaging/release
release-check:
	packaging/check
release-twice:
	packaging/twice $(TARGET)

# The program as a web page (docs/web.md): index.html for a server and stargrip-cam.html for a disk, in target/web. Needs the target and Python 3.
WASM = wasm32-unknown-unknown
web:
	@test -d "$$(rustc --print sysroot)/lib/rustlib/$(WASM)" || { echo "a target is missing: run \`rustup target add $(WASM)\`" >&2; exit 1; }
	CARGO_ENCODED_RUSTFLAGS="$$(packaging/flags "$$PWD")" $(CARGO) build --locked --profile page -p stargrip-cam-web --target $(WASM)
	web/make-page target/$(WASM)/page/stargrip_cam_web.wasm target/web

# Book and page as one static site in target/site.
site: docs web
	web/make-site target/book target/web target/site

# The Python package (docs/python.md): `wheel` builds it in target/wheels; `python` also tests it in a virtual environment below target/.
wheel:
	python/run wheel
python:
	python/run check

# Checks that it compiles for Windows and macOS if their standard libraries are installed; TARGETS names other systems.
portable:
	packaging/portable $(TARGETS)

# The crates of the program.
CRATES = $(addprefix -p stargrip-,geom artwork sealed inflatable spec design forecast program proof)
# The tested crates. The Python package has its own tests (`make python`).
TESTED = -p stargrip-cam $(CRATES) -p research
# A crate is compiled again for its unit tests. They are as fast when that copy is not optimised, and it is there sooner. `research` has no
# unit tests, so the root is not compiled that way for it, too.
UNITS = -p stargrip-cam $(CRATES)
PLAIN = --config 'profile.dev.package.stargrip-cam.opt-level=0'
# `check` compiles the examples with its lints; a test that needs one includes it as a module.
test:
	$(CARGO) test --locked --lib $(PLAIN) $(UNITS)
	$(CARGO) test --locked --test '*' $(TESTED)
	$(CARGO) test --locked --doc $(TESTED)

# The first part of CI: format, dependencies, the lock file of the fuzz targets, lints, debug tests, the files of the release program, documentation.
check:
	$(CARGO) fmt --all --check
	$(MAKE) deny
	$(CARGO) tree --manifest-path fuzz/Cargo.toml --locked >/dev/null
	$(NO_PYTHON) $(CARGO) clippy --locked --workspace --all-targets -- -D warnings
	$(MAKE) test
	$(RELEASE)
	$(CARGO) test --locked --test golden -- --ignored
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --locked --no-deps --document-private-items $(TESTED)

# The pages of docs/ as a book, target/book/index.html. `make test` holds its list, links and pictures, so CI does not build it.
MDBOOK = $(shell PATH="$$PATH:target/ci-tools/bin" command -v mdbook)
docs:
	@test -n "$(MDBOOK)" || { echo "mdbook is missing: run \`cargo install --locked mdbook\`" >&2; exit 1; }
	$(MDBOOK) build
	@echo "open target/book/index.html"

# Checks licences, duplicate versions and sources of all dependencies by deny.toml, offline, in a second.
deny:
	@$(call needs,deny,cargo-deny)
	$(CARGO) deny --workspace --locked check licenses bans sources

# Known vulnerabilities of the dependencies. Not part of `check`: the list changes independently of this repository.
audit:
	@$(call needs,deny,cargo-deny)
	$(CARGO) deny --workspace --locked check advisories

# Mutants of FILES that no test detects (docs/testing.md): `make mutants FILES='crates/program/src/plan/*.rs' SHARD=0/8`.
FILES ?= crates/program/src/plan/*.rs
SHARD ?= 0/1
mutants:
	@$(call needs,mutants,cargo-mutants)
	mkdir -p target
	PROPTEST_RNG_SEED=20 INSTA_UPDATE=no $(CARGO) mutants -f '$(FILES)' --shard $(SHARD) -o target/mutants -- --locked --tests

# Runs each fuzz target for TIME seconds and prints the totals (docs/reliability.md): `make fuzz TIME=600 TARGETS='resume gcode'`.
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

# Independent readers check every output of every shipped design. Needs root for apt-get.
strangers:
	$(RELEASE)
	tests/strangers/run

# Larger programs check some designs before a release: FreeCAD, PrusaSlicer, OctoPrint's analysis, a CUPS filter (docs/testing.md).
strangers-more:
	$(RELEASE)
	tests/strangers/more

bench:
	$(CARGO) bench --locked -p benches
