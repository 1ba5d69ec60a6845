/* The serial line: USART2 at 115200 baud, both directions through buffers filled and emptied by its interrupt. */
#ifndef USART_H
#define USART_H

#include <stdint.h>

void usart_start(void);
/* The next byte that came, or -1. */
int usart_read(void);
/* How many bytes `usart_write` would take now. */
uint16_t usart_room(void);
/* Takes all of them or none: a frame is never cut. Returns whether it did. */
uint8_t usart_write(const uint8_t *bytes, uint8_t count);
/* Whether everything written has left the buffer. */
uint8_t usart_idle(void);
void USART2_IRQHandler(void);

#endif
