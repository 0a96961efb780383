# How wrong the solver is, benchmark by benchmark, and what accuracy costs. Included by the Makefile.
#
#   make -C pipelines validate         all benchmarks; then one line a quantity, measured against its bar
#   make -C pipelines validate-tank    one of them (a folder in validation/); the table keeps the rows of the others
#   make -C pipelines validate-clean   removes all their results; validate-clean-tank those of one
#   make -C pipelines accuracy-docs    writes what was found into docs/: accuracy-table.md, error-vs-time.png
#   make -C pipelines error-vs-time    the study of schemes: error against run time, as table and figure
#
# LEVELS says which of the runs in validation/*/runs.txt are made: full (the default), quick (seconds; what the tests do),
# fine (hours), or several: LEVELS="full fine". A rebuilt tool reruns nothing, an edit of a case or of its runs does.

LEVELS ?= full
validation := $(here)/validation
validation_out := $(here)/out/validation
study_out := $(here)/out/error-vs-time
validation_cases := $(notdir $(patsubst %/runs.txt,%,$(wildcard $(validation)/*/runs.txt)))
study_cases := $(notdir $(patsubst %/study.txt,%,$(wildcard $(validation)/*/study.txt)))
lgiw_validation := $(bin)/lgiw-validation
ifndef BIN
$(lgiw_validation): compile
	@:
endif

# CASE/RUN of the lists FILE that have one of the levels; a line of a list is: run, its levels, arguments of dem2particles.
listed_runs = $(shell cd $(validation) && awk -v levels="$(2)" '\
  BEGIN {n = split(levels, wanted, /[ ,]+/)} \
  /^[^\#]/ && NF >= 2 {for (k = 1; k <= n; ++k) if ("," $$2 "," ~ "," wanted[k] ",") { \
    print substr(FILENAME, 1, index(FILENAME, "/")) $$1; break}}' */$(1))
validation_runs := $(call listed_runs,runs.txt,$(LEVELS))
study_runs := $(call listed_runs,study.txt,full)

# What the tools write of a run of a case.
case_has = $(shell grep -q '^$(2) *:' $(validation)/$(1)/case.yaml && echo $(2))
find_tables = run.json $(if $(call case_has,$(1),gauges),gauges.csv) $(if $(call soil_slide,$(validation)/$(1)/case.yaml),slide.csv)
$(foreach case,$(validation_cases),$(eval case_tables_$(case) := $(call find_tables,$(case))))
# Of all runs of case $(1) in the list $(2), below the folder $(3).
case_results = $(foreach run,$(filter $(1)/%,$(2)),$(addprefix $(3)/$(run)/,$(case_tables_$(1))))

.PHONY: validate validate-operators accuracy-docs validate-runs validate-clean error-vs-time error-vs-time-clean FORCE
.PHONY: $(addprefix validate-,$(validation_cases)) $(addprefix validate-clean-,$(validation_cases))
validate: $(addprefix $(validation_out)/,$(addsuffix /rows.csv,operators $(validation_cases)))
validate-operators: $(validation_out)/operators/rows.csv
$(foreach case,$(validation_cases),$(eval validate-$(case): $(validation_out)/$(case)/rows.csv))
validate $(addprefix validate-,operators $(validation_cases)): | $(lgiw_validation)
	@$(lgiw_validation) merge $(validation_out) -o $(here)/out/validation.csv -O

# The table and figure of docs/accuracy.md from what has been run.
accuracy-docs: | $(lgiw_validation)
	$(lgiw_validation) table $(here)/out/validation.csv -o $(root)/docs/accuracy-table.md -O
	cp $(here)/out/error-vs-time.png $(root)/docs/

# The runs alone, without judging them.
validate-runs: $(foreach case,$(validation_cases),$(call case_results,$(case),$(validation_runs),$(validation_out)))

validate-clean:
	rm -rf $(validation_out) $(here)/out/validation.csv
$(addprefix validate-clean-,$(validation_cases)): validate-clean-%:
	rm -rf $(validation_out)/$*

error-vs-time: $(here)/out/error-vs-time.png
error-vs-time-clean:
	rm -rf $(study_out) $(here)/out/error-vs-time.csv $(here)/out/error-vs-time.png

$(here)/out/error-vs-time.csv: $(addprefix $(study_out)/,$(addsuffix /rows.csv,$(study_cases))) | $(lgiw_validation)
	$(lgiw_validation) join $^ -o $@ -O

$(here)/out/error-vs-time.png: $(here)/figures/error-vs-time.gp $(here)/figures/common.gp $(here)/out/error-vs-time.csv
	@echo "figure $(@F)"; gnuplot -e "table='$(here)/out/error-vs-time.csv'" -e "set loadpath '$(here)/figures'; set output '$@'" $<

# --- Runs: below the folder $(1), from the lists $(2) -----------------------------------------------------------------
define benchmark_runs
.PRECIOUS: $(1)/%/overrides $(1)/%/particles.h5 $(1)/%/run.json
# Written only when it changes, so that an edit of one run's line reruns that run.
$(1)/%/overrides: FORCE
	@mkdir -p $$(@D)
	@awk '$$$$1 == "$$(*F)" {$$$$1 = $$$$2 = ""; print}' $(validation)/$$(*D)/$(2) > $$@.new
	@if cmp -s $$@.new $$@; then rm $$@.new; else mv $$@.new $$@; fi

$(1)/%/particles.h5: $(validation)/$$$$(*D)/case.yaml $(1)/%/overrides | $(dem2particles)
	$(dem2particles) $$< $$$$(cat $$(@D)/overrides) -o $$@ -O -q

# One run at a time, even under make -j: they are timed.
$(1)/%/run.json $(1)/%/run.h5: $(1)/%/particles.h5 | $(lgiw_run)
	flock $(here)/out/.runs $(lgiw_run) $$< -o $$(@D)/run.h5 -O -q --summary $$(@D)/run.json

$(1)/%/gauges.csv: $(1)/%/run.h5 | $(gauges_tool)
	$(gauges_tool) $$< -o $$@ -O -q --long

$(1)/%/slide.csv: $(1)/%/run.h5 | $(deposit_volume)
	$(deposit_volume) $$< -o $$@ -O -q
endef

.SECONDEXPANSION:
$(eval $(call benchmark_runs,$(validation_out),runs.txt))
$(eval $(call benchmark_runs,$(study_out),study.txt))

# No runs: the laws of lib/physics on manufactured fields.
$(validation_out)/operators/rows.csv: | $(lgiw_validation)
	@mkdir -p $(@D)
	$(lgiw_validation) operators -o $@ -O

$(validation_out)/%/rows.csv: $(validation)/%/checks.yaml $(validation)/%/runs.txt \
    $$(call case_results,$$*,$(validation_runs),$(validation_out)) | $(lgiw_validation)
	$(lgiw_validation) check $(if $(filter full fine,$(LEVELS)),,--quick) $(validation)/$* $(validation_out)/$* -o $@ -O

$(study_out)/%/rows.csv: $(validation)/%/study.yaml $(validation)/%/study.txt \
    $$(call case_results,$$*,$(study_runs),$(study_out)) | $(lgiw_validation)
	$(lgiw_validation) study $(validation)/$* $(study_out)/$* -o $@ -O
