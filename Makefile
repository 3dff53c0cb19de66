# SPDX-License-Identifier: GPL-3.0-or-later
# make            build/softworld (host program) and build/softworld/core.so
# make spec       all tests            make lint     house rules and checkers
# make asan       all tests under AddressSanitizer and UBSan
# make fuzz       random calls of everything, under both; ARGS="seed=7 calls=1e5"
# make format     clang-format over csrc
# make bench      speed and accuracy   make chart    draw them
# make stability  largest stable steps make examples run every example
# make manual    the manual as HTML, in build/manual
# make install PREFIX=/usr/local
PREFIX = /usr/local
BUILD = build
CC = gcc
PKG = lua5.4 gsl ccd assimp zlib

# Value-safe speed only: no -ffast-math, NaN checks and reproducible bits need IEEE rules. Nobody
# replaces a function of the core by another one at load time, so they are inlined within a file.
OPT = -O3 -fno-math-errno -fno-trapping-math -ffp-contract=fast -fno-semantic-interposition
# Structures of some hundred bytes are cleared and copied by stores or by the C library. By itself gcc
# takes the processor's string instructions for up to 8 kB, which are slow to begin. Only for
# compilers that know these options.
COPIES = -mmemset-strategy=unrolled_loop:128:noalign,libcall:-1:noalign \
  -mmemcpy-strategy=unrolled_loop:128:noalign,libcall:-1:noalign
OPT += $(shell $(CC) $(COPIES) -E -x c /dev/null >/dev/null 2>&1 && echo $(COPIES))
# -Wno-psabi: wide vectors are handed over inside one file only.
WARN = -Wall -Wextra -Wshadow -Wmissing-prototypes -Wstrict-prototypes -Wdouble-promotion \
  -Wpointer-arith -Wwrite-strings -Wvla -Wno-psabi
CPPFLAGS = -Icsrc -D_GNU_SOURCE $(shell pkg-config --cflags $(PKG))
CFLAGS = -std=c11 -g $(OPT) $(WARN) $(SAN) -fPIC
LIBS = $(shell pkg-config --libs gsl ccd assimp zlib) -lqhull_r -lcholmod -lamd -lcivetweb -lnlopt -lm
LUALIB = $(shell pkg-config --libs lua5.4)

SRC = $(filter-out $(wildcard csrc/host/*.c csrc/probe/*.c),$(wildcard csrc/*/*.c))
HOST = $(wildcard csrc/host/*.c)
PAGE = $(BUILD)/page/player.html
OBJ = $(SRC:csrc/%.c=$(BUILD)/obj/%.o) $(BUILD)/obj/page.o $(BUILD)/obj/font.o
HOSTOBJ = $(HOST:csrc/%.c=$(BUILD)/obj/%.o)
PROBEOBJ = $(patsubst csrc/%.c,$(BUILD)/obj/%.o,$(wildcard csrc/probe/*.c))

all: $(BUILD)/softworld $(BUILD)/lib/softworld/core.so $(BUILD)/lib/softworld/probe.so

$(BUILD)/softworld: $(OBJ) $(HOSTOBJ)
	$(CC) $(SAN) -Wl,-E -o $@ $^ $(LIBS) $(LUALIB) -lreadline

# Stays loaded: libraries behind it do not bear being taken away.
$(BUILD)/lib/softworld/core.so: $(OBJ)
	@mkdir -p $(@D)
	$(CC) $(SAN) -shared -Wl,-z,nodelete -o $@ $^ $(LIBS)

# For specs and benches, within the program only, which has the core; not installed.
$(BUILD)/lib/softworld/probe.so: $(PROBEOBJ)
	@mkdir -p $(@D)
	$(CC) $(SAN) -shared -o $@ $^

$(BUILD)/obj/%.o: csrc/%.c Makefile
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(CFLAGS) -MMD -MP -c -o $@ $<

# The player's page, without network and in one file: scripts and styles are bundled into it. It is
# a part of the program, which then need not look for it.
WEB = /usr/share/javascript
PAGE_SRC = $(wildcard lua/softworld/page/*)
$(PAGE): $(PAGE_SRC) scripts/page.lua Makefile
	@mkdir -p $(@D)
	esbuild lua/softworld/page/main.js --bundle --minify --format=iife --target=chrome90,firefox113 \
	  --legal-comments=inline --log-level=warning --outfile=$(@D)/player.js \
	  --alias:three=$(WEB)/three/three.module.js \
	  --alias:three-controls=$(WEB)/three/examples/jsm/controls/OrbitControls.js --alias:dygraphs=$(WEB)/dygraphs/dygraph.min.js \
	  --alias:dygraphs.css=$(WEB)/dygraphs/dygraph.css
	lua5.4 scripts/page.lua lua/softworld/page $(@D) $@

$(BUILD)/obj/page.o: $(PAGE)
	@mkdir -p $(@D)
	printf '%s\n' '.section .rodata' '.global lsw_page_start' '.global lsw_page_end' \
	  '.hidden lsw_page_start' '.hidden lsw_page_end' 'lsw_page_start: .incbin "$<"' \
	  'lsw_page_end:' '.section .note.GNU-stack,"",%progbits' | $(CC) -x assembler -c -o $@ -

# Letters in pictures: outlines of a font, also a part of the program.
FONT = /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf
$(BUILD)/font.bin: $(FONT) scripts/font.lua Makefile
	@mkdir -p $(@D)
	lua5.4 scripts/font.lua $(FONT) $@

$(BUILD)/obj/font.o: $(BUILD)/font.bin
	@mkdir -p $(@D)
	printf '%s\n' '.section .rodata' '.global sw_font_start' '.hidden sw_font_start' \
	  'sw_font_start: .incbin "$<"' '.section .note.GNU-stack,"",%progbits' | $(CC) -x assembler -c -o $@ -

-include $(OBJ:.o=.d) $(HOSTOBJ:.o=.d) $(PROBEOBJ:.o=.d)

# The host finds share/lua/5.4 beside its own bin; stock lua5.4 has both folders
# on its default paths when PREFIX is /usr/local or /usr.
DEST = $(DESTDIR)$(PREFIX)
install: all
	install -D $(BUILD)/softworld $(DEST)/bin/softworld
	install -D -m 644 $(BUILD)/lib/softworld/core.so $(DEST)/lib/lua/5.4/softworld/core.so
	find lua/softworld -name '*.lua' -o -name '*.md' -o -path '*/study/page/*' | while read -r f; do \
	  install -D -m 644 "$$f" "$(DEST)/share/lua/5.4/$${f#lua/}" || exit 1; done

clean:
	rm -rf $(BUILD) build-asan

# make spec ARGS="--name catenary": options of scripts/spec.lua
spec: all
	@$(BUILD)/softworld scripts/spec.lua $(ARGS)

lint:
	@lua5.4 scripts/lint.lua

format:
	clang-format -i $(wildcard csrc/*.[ch] csrc/*/*.[ch])

MAKE_ASAN = $(MAKE) BUILD=build-asan OPT="-O1 -fno-omit-frame-pointer" \
  SAN="-fsanitize=address,undefined -fno-sanitize-recover=all" all
UNDER_ASAN = ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1:detect_stack_use_after_return=1 \
  UBSAN_OPTIONS=print_stacktrace=1 \
  LSAN_OPTIONS=suppressions=$(CURDIR)/scripts/lsan.supp:print_suppressions=0 \
  SOFTWORLD_PRELOAD="$$($(CC) -print-file-name=libasan.so)"

# Stock lua5.4 needs $$SOFTWORLD_PRELOAD as LD_PRELOAD to load this core.so.
asan:
	@$(MAKE_ASAN)
	@$(UNDER_ASAN) build-asan/softworld scripts/spec.lua --timeout 3000 $(ARGS)

# a case takes many times as long here, and memory is what the sanitizers want
fuzz:
	@$(MAKE_ASAN)
	@$(UNDER_ASAN) build-asan/softworld scripts/fuzz.lua cpu=1500 slow=1000 $(ARGS)


examples: all
	@for example in examples/*.lua; do echo "== $$example"; $(BUILD)/softworld $$example || exit 1; done

# make bench ARGS="quick case=release model=rod"
bench: all
	@$(BUILD)/softworld scripts/bench.lua $(ARGS)

# draws out/bench/*.csv and the README's chart
chart: all
	@$(BUILD)/softworld scripts/chart.lua $(ARGS)

stability: all
	@$(BUILD)/softworld scripts/stability.lua $(ARGS)

manual: all
	@$(BUILD)/softworld scripts/manual.lua folder=$(BUILD)/manual

.PHONY: bench examples chart stability manual all clean spec lint format asan fuzz install
