# The Uno's firmware with Debian's compiler; the Arduino IDE opens deltalab/deltalab.ino as it is.
#   make uno VARIANT=delta3_dc                     firmware in $(BUILD)/uno_delta3_dc.elf and .hex
#   make uno-size VARIANT=delta3_dc                its flash and RAM
#   make uno-upload VARIANT=delta3_dc PORT=/dev/ttyACM0
# VARIANT: delta3_servo, delta3_dc or linear_stepper.

BUILD ?= build
VARIANT ?= delta3_servo
PORT ?= /dev/ttyACM0

UNO_HERE := $(dir $(lastword $(MAKEFILE_LIST)))
UNO_SKETCH := $(UNO_HERE)deltalab
UNO_ARDUINO ?= /usr/share/arduino/hardware/arduino/avr
# Without Tone.cpp, which would take TIMER2's interrupt; the IDE links it only into sketches that call tone().
UNO_LIBRARY = $(filter-out %/Tone.cpp,$(wildcard $(UNO_ARDUINO)/cores/arduino/*.c $(UNO_ARDUINO)/cores/arduino/*.cpp))
UNO_CORE = $(wildcard $(UNO_SKETCH)/src/core/*.c)
UNO_HEADERS = $(wildcard $(UNO_SKETCH)/*.h $(UNO_SKETCH)/src/core/*.h)
UNO_ELF = $(BUILD)/uno_$(VARIANT).elf
UNO_OBJECTS = $(BUILD)/uno_$(VARIANT).objects
UNO_DEFINE := DL_BUILD_$(shell echo $(VARIANT) | tr a-z A-Z)

# Arduino's WString.cpp needs DECIMAL_DIG, which Debian's avr-gcc 5.4 does not define.
UNO_FLAGS = -mmcu=atmega328p -DF_CPU=16000000L -DARDUINO=10819 -DARDUINO_AVR_UNO -DARDUINO_ARCH_AVR \
	-DDECIMAL_DIG=__DECIMAL_DIG__ -D$(UNO_DEFINE) \
	-I$(UNO_ARDUINO)/cores/arduino -I$(UNO_ARDUINO)/variants/standard -I$(UNO_SKETCH) \
	-Os -g -flto -fuse-linker-plugin -ffunction-sections -fdata-sections
UNO_CXX = -std=gnu++11 -fno-exceptions -fno-threadsafe-statics
UNO_STRICT = -Wall -Wextra -Werror

.PHONY: uno uno-size uno-upload
uno: $(UNO_ELF:.elf=.hex)

$(UNO_ELF): $(UNO_SKETCH)/deltalab.ino $(UNO_CORE) $(UNO_HEADERS) $(lastword $(MAKEFILE_LIST))
	mkdir -p $(UNO_OBJECTS)
	avr-gcc $(UNO_FLAGS) $(UNO_CXX) $(UNO_STRICT) -c -x c++ $< -o $(UNO_OBJECTS)/deltalab.o
	for source in $(UNO_CORE); do \
		avr-gcc $(UNO_FLAGS) -std=gnu99 $(UNO_STRICT) -c $$source -o $(UNO_OBJECTS)/$$(basename $$source .c).o || exit 1; \
	done
	avr-gcc $(UNO_FLAGS) $(UNO_CXX) -fpermissive -w $(UNO_OBJECTS)/*.o $(UNO_LIBRARY) -Wl,--gc-sections -lm -o $@

%.hex: %.elf
	avr-objcopy -O ihex -R .eeprom $< $@

uno-size: $(UNO_ELF)
	avr-size -C --mcu=atmega328p $<

uno-upload: uno
	avrdude -p m328p -c arduino -P $(PORT) -b 115200 -D -U flash:w:$(UNO_ELF:.elf=.hex):i
