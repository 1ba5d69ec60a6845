#include "usart.h"

#include "figures.h"
#include "gpio.h"

/* A ring of bytes between the interrupt and the main loop; its indices run on and wrap by themselves. */
enum { SIZE = 256 };
typedef struct {
    volatile uint8_t bytes[SIZE];
    volatile uint16_t in, out;
} ring;

static ring received, sending;

static uint16_t filled(const ring *r) { return (uint16_t)(r->in - r->out); }

static void put(ring *r, uint8_t byte)
{
    if (filled(r) == SIZE) return; /* the CRC finds the gap */
    r->bytes[r->in % SIZE] = byte;
    r->in++;
}

static uint8_t take(ring *r)
{
    const uint8_t byte = r->bytes[r->out % SIZE];
    r->out++;
    return byte;
}

void usart_start(void)
{
    pin_alternate(PIN_SERIAL_TX, AF_USART2);
    pin_pullup(PIN_SERIAL_RX); /* an open line is silent, not noisy */
    pin_alternate(PIN_SERIAL_RX, AF_USART2);
    USART2->BRR = usart_divider(APB1_HZ, 115200);
    USART2->CR1 = USART_UE | USART_TE | USART_RE | USART_RXNEIE;
    NVIC_ENABLE(IRQ_USART2);
}

int usart_read(void) { return filled(&received) ? take(&received) : -1; }

uint16_t usart_room(void) { return SIZE - filled(&sending); }

uint8_t usart_idle(void) { return filled(&sending) == 0; }

uint8_t usart_write(const uint8_t *bytes, uint8_t count)
{
    if (count > usart_room()) return 0;
    for (uint8_t i = 0; i < count; i++) put(&sending, bytes[i]);
    interrupts_off(); /* the handler clears the same bit */
    USART2->CR1 |= USART_TXEIE;
    interrupts_on();
    NVIC_PEND(IRQ_USART2); /* QEMU never raises this interrupt for a free transmitter; a chip does so anyway */
    return 1;
}

void USART2_IRQHandler(void)
{
    const uint32_t status = USART2->SR;
    if (status & (USART_RXNE | USART_ORE)) { /* reading both registers also ends an overrun */
        const uint8_t byte = (uint8_t)USART2->DR;
        if (status & USART_RXNE) put(&received, byte);
    }
    while (filled(&sending) && USART2->SR & USART_TXE) USART2->DR = take(&sending);
    if (!filled(&sending)) USART2->CR1 &= ~(uint32_t)USART_TXEIE;
}
