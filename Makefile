# The four things people do. Each target does everything it needs on a fresh Debian 12 machine.
.PHONY: build demo test verify-long sanitize packages clean

JOBS ?= $(shell nproc)
KARDAN := build/release/bin/kardan
DEMO := results/slider_crank

build: packages
	cmake --preset release
	cmake --build --preset release -j $(JOBS)

demo: packages
	cmake --preset release
	cmake --build --preset release -j $(JOBS) --target kardan
	$(KARDAN) run examples/slider_crank/slider_crank.k -o $(DEMO)
	@echo
	@echo "The mechanism moved: its results are in $(DEMO)/."
	@echo "  LS-PrePost:  File > Open > LS-DYNA Binary Plot > $(DEMO)/d3plot, then Post > ASCII or Binout for the curves"
	@echo "  ParaView:    File > Open > $(DEMO)/d3plot (reader: LS-DYNA)"
	@echo "  Picture:     tools/render_d3plot.py $(DEMO)/d3plot picture.png"

test: build
	ctest --preset release -j $(JOBS)

verify-long: build
	$(KARDAN) verify mechanisms-long deformable-long contact-long
	KARDAN_LONG=1 build/release/bin/kardan_test_app --gtest_filter='CorpusRun.*'

sanitize: packages
	cmake --preset sanitize
	cmake --build --preset sanitize -j $(JOBS)
	ctest --preset sanitize -j $(JOBS)

packages:
	@tools/install_packages.sh packages.txt

clean:
	rm -rf build results
