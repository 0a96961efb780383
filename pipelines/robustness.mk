# Is anything lost, whatever happens. Included by the Makefile.
#
#   make -C pipelines robustness   kills, full and read-only disks, damaged checkpoints, too little memory, threads and
#                                  resumption: out/robustness.json and .txt. COUNTS as below; ROBUSTNESS_TESTS names some.
#   make -C pipelines load         an hour of the demo with ten times its particles: LOAD_SECONDS of model time
#   make -C pipelines fuzz         every reader of ours, MINUTES (60) each, under ASan and UBSan; needs clang
#   make -C pipelines sanitize     the quick suite under ASan and UBSan; SANITIZE_TESTS=REGEX takes some
#   make -C pipelines races        every pass of the CPU solver on two threads under ThreadSanitizer; needs clang and libomp
#   make -C pipelines lint         static analysis: cppcheck
#
# docs/robustness.md has what they gave, and what each one means.

ROBUSTNESS_TESTS ?= kill-test fault-test corrupt-test disk-full-test memory-test determinism-test
KILLS ?= 100
STRIDE ?= 1
PLACES ?= 200
SIZES_OF_DISK ?= 20
LIMITS ?= 20
count_of = $(strip $(if $(filter kill-%,$(1)),$(KILLS),$(if $(filter fault-%,$(1)),$(STRIDE),$(if $(filter corrupt-%,$(1)),$(PLACES),\
  $(if $(filter disk-%,$(1)),$(SIZES_OF_DISK),$(if $(filter memory-%,$(1)),$(LIMITS),3))))))
robustness := $(root)/tests/robustness
# In memory where there is room: a disk that must be waited for at every call takes most of the time.
robustness_work := $(or $(wildcard /dev/shm),$(here)/out/.work)/lgiw-robustness

.PHONY: robustness load fuzz sanitize races lint
robustness: $(tools)
	@mkdir -p $(here)/out
	@failed=0; $(foreach test,$(ROBUSTNESS_TESTS),\
	  { $(robustness)/$(test) $(bin) $(robustness_work)/$(test) $(call count_of,$(test)) || [ $$? -eq 77 ] || failed=1; } > $(here)/out/.$(test).json;)\
	  jq -s . $(ROBUSTNESS_TESTS:%=$(here)/out/.%.json) > $(here)/out/robustness.json; rm -f $(ROBUSTNESS_TESTS:%=$(here)/out/.%.json); \
	  jq -r '.[] | .test + ": " + (to_entries | map(select(.key != "test") | .key + " " + (.value | tostring)) | join(", "))' \
	    $(here)/out/robustness.json | tee $(here)/out/robustness.txt; exit $$failed

LOAD_SECONDS ?= 500
load: $(tools)
	$(robustness)/load-test $(bin) $(here)/out/.work/load-test $(LOAD_SECONDS) | tee $(here)/out/load.json
	rm -r $(here)/out/.work/load-test

MINUTES ?= 60
fuzz:
	cmake -S $(root) -B $(root)/build/fuzz -G Ninja -DLGIW_FUZZ=ON -DLGIW_CUDA=OFF -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=-O1 -g"
	cmake --build $(root)/build/fuzz --target fuzz_targets
	$(root)/tests/fuzz/fuzz $(root)/build/fuzz $(MINUTES)

# Of the instruction sets the baseline: the passes are the same source.
SANITIZE_TESTS ?= .
sanitize:
	cd $(root) && cmake --preset asan && cmake --build --preset asan
	cd $(root)/build/asan && ctest --output-on-failure -E 'Robustness' -R '$(SANITIZE_TESTS)'

races:
	cd $(root) && cmake --preset tsan && cmake --build --preset tsan
	$(root)/tests/robustness/race-test $(root)/build/tsan/bin $(robustness_work)/race-test

lint:
	cppcheck --quiet --std=c++20 --language=c++ --enable=warning,performance,portability --inline-suppr --error-exitcode=1 \
	  --suppressions-list=$(root)/cmake/cppcheck-suppressions -I $(root)/lib $(root)/lib $(root)/tools
