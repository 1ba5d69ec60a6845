# The STM32F407 Discovery's firmware with Debian's compiler.
#   make stm32 VARIANT=par4_dc          firmware in $(BUILD)/stm32_par4_dc.elf, .bin and .hex
#   make stm32-size VARIANT=par4_dc     its flash and RAM
#   make stm32-upload VARIANT=par4_dc   onto the board, through its ST-LINK
# VARIANT: par4_dc (default), fivebar_dc or linear_stepper. DISPLAY=0 leaves the text display out.

BUILD ?= build

STM32_HERE := $(dir $(lastword $(MAKEFILE_LIST)))
STM32_CORE := $(STM32_HERE)deltalab/src/core
STM32_VARIANTS := par4_dc fivebar_dc linear_stepper
# Only where somebody has chosen it: uno.mk has a default of its own.
STM32_VARIANT := $(if $(filter command environment,$(origin VARIANT)),$(VARIANT),par4_dc)
STM32_NAME = $(BUILD)/stm32_$(STM32_VARIANT)
STM32_OBJECTS = $(BUILD)/stm32_objects
STM32_CORE_SOURCES = $(wildcard $(STM32_CORE)/*.c)
STM32_SOURCES = $(filter-out %/build.c,$(wildcard $(STM32_HERE)stm32/*.c))
STM32_HEADERS = $(wildcard $(STM32_HERE)stm32/*.h $(STM32_CORE)/*.h)
STM32_COMMON = $(patsubst $(STM32_CORE)/%.c,$(STM32_OBJECTS)/core/%.o,$(STM32_CORE_SOURCES)) \
	$(patsubst $(STM32_HERE)stm32/%.c,$(STM32_OBJECTS)/%.o,$(STM32_SOURCES))
STM32_DEFINES = -DDL_BUILD_$(shell echo $* | tr a-z A-Z) $(if $(DISPLAY),-DDL_DISPLAY=$(DISPLAY))
STM32_COMPILE := arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard -std=gnu99 -O2 -g \
	-Wall -Wextra -Werror -Wdouble-promotion -ffunction-sections -fdata-sections -I$(STM32_CORE) -I$(STM32_HERE)stm32
STM32_LINK := -nostartfiles -specs=nano.specs -specs=nosys.specs -T $(STM32_HERE)stm32/link.ld \
	-Wl,--gc-sections -Wl,--no-warn-rwx-segments -lm

.PHONY: stm32 stm32-size stm32-upload
.SECONDARY: $(STM32_COMMON)
stm32: $(STM32_NAME).bin $(STM32_NAME).hex

stm32-size: $(STM32_NAME).elf
	arm-none-eabi-size $<

stm32-upload: $(STM32_NAME).bin
	st-flash --reset write $< 0x8000000

$(STM32_OBJECTS)/core/%.o: $(STM32_CORE)/%.c $(STM32_HEADERS)
	@mkdir -p $(@D)
	$(STM32_COMPILE) -c $< -o $@

$(STM32_OBJECTS)/%.o: $(STM32_HERE)stm32/%.c $(STM32_HEADERS)
	@mkdir -p $(@D)
	$(STM32_COMPILE) -c $< -o $@

$(BUILD)/stm32_%.elf: $(STM32_HERE)stm32/build.c $(STM32_HERE)stm32/link.ld $(STM32_COMMON)
	$(if $(filter $*,$(STM32_VARIANTS)),,$(error There is no STM32 firmware $*: choose one of $(STM32_VARIANTS)))
	$(STM32_COMPILE) $(STM32_DEFINES) $< $(STM32_COMMON) $(STM32_LINK) -o $@

$(BUILD)/stm32_%.bin: $(BUILD)/stm32_%.elf
	arm-none-eabi-objcopy -O binary $< $@

$(BUILD)/stm32_%.hex: $(BUILD)/stm32_%.elf
	arm-none-eabi-objcopy -O ihex $< $@
