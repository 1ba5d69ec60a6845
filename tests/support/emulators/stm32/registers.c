/* The processor's registers as plain memory, for the drivers compiled on a desktop. */
#include "figures.h"
#include "stm32f4.h"

uint8_t host_registers[1 << 20];

/* Pins take over what was asked of them; a converter that has power converts at once. */
void host_reacts(void)
{
    for (uint8_t port = 0; port < 5; port++) {
        const uint32_t asked = GPIO(port)->BSRR;
        GPIO(port)->ODR = (GPIO(port)->ODR & ~(asked >> 16)) | (asked & 0xFFFF);
        GPIO(port)->BSRR = 0;
    }
    if (ADC1->CR2 & ADC_ADON && ADC1->CR2 & ADC_JSWSTART) ADC1->SR |= ADC_JEOC;
    ADC1->CR2 &= ~(uint32_t)ADC_JSWSTART;
}

uint32_t host_usart_divider(uint32_t clock_hz, uint32_t baud) { return usart_divider(clock_hz, baud); }
uint32_t host_watchdog_reload(uint32_t milliseconds) { return watchdog_reload(milliseconds); }
uint32_t host_compare_for(float share, uint32_t reload) { return compare_for(share, reload); }
