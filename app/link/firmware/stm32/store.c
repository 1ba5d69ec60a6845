#include "store.h"

#include <stddef.h>

#include "chip.h"
#include "emulator.h"
#include "stm32f4.h"

/* Sector 3, 16 KB; the program keeps to sectors 0 to 2 (link.ld). */
#define SECTOR ((volatile uint32_t *)AT(0x0800C000u))
enum { SECTOR_NUMBER = 3, PATIENCE = 50000000 };
#define WRITTEN 0x31534C44u /* "DLS1", before the image; erased flash is all ones */
#define KEY_1 0x45670123u
#define KEY_2 0xCDEF89ABu

#ifdef DL_HOST_REGISTERS
#define IN_RAM
#else
#define IN_RAM __attribute__((section(".ramfunc"), noinline, long_call))
#endif

static volatile uint32_t *memory(void) { return emulated ? sim.store : SECTOR; }

const uint8_t *store_read(void)
{
    const volatile uint32_t *store = memory();
    return store[0] == WRITTEN ? (const uint8_t *)(store + 1) : NULL;
}

/* While the flash is busy no instruction can be fetched from it. So this runs from RAM, undisturbed by interrupts,
 * and feeds the watchdog itself: erasing takes half a second. */
IN_RAM static void program(const uint32_t *words)
{
    FLASH->KEYR = KEY_1;
    FLASH->KEYR = KEY_2;
    FLASH->SR = FLASH_ERRORS;
    for (int i = -1; i < STORE_WORDS; i++) {
        if (i < 0) {
            FLASH->CR = FLASH_SER | SECTOR_NUMBER << FLASH_SECTOR | FLASH_PSIZE_32;
            FLASH->CR |= FLASH_STRT;
        } else {
            FLASH->CR = FLASH_PG | FLASH_PSIZE_32;
            SECTOR[i] = words[i];
        }
        for (uint32_t wait = 0; FLASH->SR & FLASH_BUSY && wait < PATIENCE; wait++) IWDG->KR = 0xAAAA;
    }
    FLASH->CR = FLASH_LOCK;
}

void store_write(const dl_machine *machine)
{
    uint32_t words[STORE_WORDS] = {WRITTEN};
    for (uint16_t i = 0; i < DL_IMAGE_BYTES; i++)
        words[1 + i / 4] |= (uint32_t)dl_image_byte(machine, i) << 8 * (i % 4);
    if (emulated) {
        for (uint16_t i = 0; i < STORE_WORDS; i++) sim.store[i] = words[i];
        return;
    }
    interrupts_off();
    program(words);
    interrupts_on();
}
