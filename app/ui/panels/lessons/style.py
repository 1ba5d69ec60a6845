"""How a lesson looks, light and dark."""

from __future__ import annotations

CLASS = "dl"
_GOOD, _BAD, _ACCENT = "#00785a", "#b3341c", "#1c6fc4"

STYLE = f"""<style>
.dl {{ padding: 2px 14px; font-size: 0.92rem; line-height: 1.5; overflow-wrap: break-word;
  --good: {_GOOD}; --bad: {_BAD}; --accent: {_ACCENT}; --line: var(--mantine-color-default-border);
  --soft: var(--mantine-color-default-hover); }}
[data-mantine-color-scheme=dark] .dl {{ --good: #3fcf9f; --bad: #ff9a7a; --accent: #74b3f2; }}
.dl > :first-child, .dl section > :first-child, .dl .card > :first-child {{ margin-top: 0; }}
.dl p {{ margin: 0.5em 0; }} .dl ul, .dl ol {{ margin: 0.5em 0; padding-left: 1.4em; }}
.dl h2 {{ font-size: 1.12rem; line-height: 1.3; margin: 0.5em 0 0.2em; }}
.dl h3 {{ font-size: 1.02rem; line-height: 1.3; margin: 0.6em 0 0.3em; }}
.dl h4 {{ font-size: 0.78rem; letter-spacing: 0.04em; text-transform: uppercase; margin: 0 0 0.3em; opacity: 0.75; }}
.dl small {{ font-size: 0.82rem; opacity: 0.85; }}
.dl code {{ font-size: 0.88em; background: var(--soft); padding: 0 3px; border-radius: 3px; }}
.dl pre {{ overflow-x: auto; background: var(--soft); padding: 6px 8px; border-radius: 6px; }}
.dl a {{ color: var(--accent); }}
.dl img {{ display: block; max-width: 100%; height: auto; margin: 0.6em auto; background: #fff; border-radius: 8px;
  padding: 6px; box-sizing: border-box; }}
.dl table {{ border-collapse: collapse; font-size: 0.86rem; margin: 0.6em 0; display: block; overflow-x: auto;
  max-width: 100%; font-variant-numeric: tabular-nums; }}
.dl th, .dl td {{ border: 1px solid var(--line); padding: 2px 7px; text-align: left; }}
.dl th {{ background: var(--soft); font-weight: 600; }}
.dl math {{ font-size: 1.06em; }}
.dl math[display=block] {{ font-size: 1.1em; margin: 0.5em 0; overflow-x: auto; overflow-y: hidden; padding: 2px 0;
  max-width: 100%; }}
.dl .equation {{ overflow-x: auto; overflow-y: hidden; max-width: 100%; }}
.dl blockquote {{ margin: 0.5em 0; padding-left: 10px; border-left: 3px solid var(--line); }}
.dl .card {{ border: 1px solid var(--line); border-radius: 8px; padding: 8px 11px; margin: 5px 0; }}
.dl .card.now {{ border-color: var(--accent); box-shadow: inset 3px 0 0 var(--accent); }}
.dl .card.later {{ opacity: 0.6; }}
.dl .warn {{ border: 2px solid #d55e00; border-radius: 8px; padding: 8px 11px; margin: 6px 0;
  background: rgba(230,159,0,.13); }}
.dl .note {{ border-left: 3px solid #8457c9; padding: 2px 10px; margin: 6px 0; background: var(--soft); }}
.dl .good {{ border-left: 3px solid var(--good); padding: 3px 10px; margin: 6px 0; background: var(--soft); }}
.dl .bad {{ border-left: 3px solid var(--bad); padding: 3px 10px; margin: 6px 0; background: var(--soft); }}
.dl .tip {{ border-left: 3px solid var(--accent); padding: 3px 10px; margin: 4px 0; background: var(--soft); }}
.dl .good > b:first-child {{ color: var(--good); }} .dl .bad > b:first-child {{ color: var(--bad); }}
.dl .good p, .dl .bad p {{ margin: 0.2em 0; }}
.dl button {{ font: inherit; font-size: 0.88rem; min-height: 32px; padding: 3px 11px; border-radius: 7px;
  cursor: pointer; color: var(--mantine-color-text); background: var(--mantine-color-default);
  border: 1px solid var(--line); touch-action: manipulation; }}
.dl button:hover {{ background: var(--soft); }}
.dl button:focus-visible, .dl input:focus-visible, .dl summary:focus-visible
  {{ outline: 2px solid var(--accent); outline-offset: 2px; }}
.dl button.main {{ background: #1c6fc4; border-color: transparent; color: #fff; font-weight: 600; }}
.dl button.quiet {{ border-color: transparent; background: none; color: var(--accent); padding: 3px 6px; }}
.dl button[aria-disabled=true] {{ color: var(--mantine-color-dimmed); background: none; border: 1px dashed var(--line);
  cursor: not-allowed; font-weight: 400; }}
.dl .row {{ display: flex; flex-wrap: wrap; gap: 7px; align-items: center; margin: 7px 0 3px; }}
.dl .row > .far {{ margin-left: auto; }}
.dl .dots {{ list-style: none; display: flex; flex-wrap: wrap; gap: 6px; margin: 4px 0; padding: 0; }}
.dl .dots button {{ min-width: 30px; min-height: 30px; padding: 0 4px; border-radius: 15px; font-size: 0.8rem; }}
.dl .dots .done {{ color: var(--good); border-color: var(--good); }}
.dl .dots .here {{ background: #1c6fc4; border-color: transparent; color: #fff; font-weight: 700; }}
.dl .option {{ display: grid; grid-template-columns: auto 1fr; gap: 8px; align-items: start; padding: 5px 8px;
  margin: 4px 0; border: 1px solid var(--line); border-radius: 7px; }}
.dl label.option {{ cursor: pointer; }} .dl label.option:hover {{ background: var(--soft); }}
.dl .option p {{ margin: 0; }}
.dl label.option input {{ margin-top: 0.35em; width: 15px; height: 15px; }}
.dl label.option:has(input:checked) {{ border-color: var(--accent); }}
.dl input[type=text] {{ font: inherit; width: 9em; min-height: 32px; padding: 2px 8px; border-radius: 7px;
  border: 1px solid var(--line); color: inherit; background: var(--mantine-color-body); }}
.dl .checks {{ list-style: none; padding: 0; margin: 4px 0; }}
.dl .checks > li {{ display: grid; grid-template-columns: 1.5em 1fr; padding: 3px 0; }}
.dl .checks p {{ margin: 0; }} .dl .checks .mark {{ font-weight: 700; }}
.dl .checks .met .mark, .dl .checks .met .word {{ color: var(--good); }}
.dl .word {{ font-weight: 600; }} .dl .num {{ font-variant-numeric: tabular-nums; }}
.dl .lesson {{ display: grid; grid-template-columns: 2em 1fr; width: 100%; text-align: left; padding: 6px 9px;
  margin: 4px 0; line-height: 1.35; box-sizing: border-box; border-radius: 8px; border: 1px solid var(--line); }}
.dl .lesson b {{ font-weight: 600; }} .dl .lesson .nr {{ opacity: 0.65; font-variant-numeric: tabular-nums; }}
.dl .lesson small {{ display: block; }}
.dl .bar {{ height: 4px; border-radius: 2px; background: var(--line); margin-top: 4px; overflow: hidden; }}
.dl .bar i {{ display: block; height: 100%; background: var(--good); }}
.dl .broken {{ border-style: dashed; opacity: 0.75; }}
.dl summary {{ cursor: pointer; }} .dl details {{ margin: 4px 0; }}
.dl .code {{ font-family: monospace; font-size: 1.05rem; letter-spacing: 0.06em; user-select: all; }}
.dl .quietly {{ position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }}
@media (pointer: coarse) {{ .dl button {{ min-height: 42px; }} .dl .dots button {{ min-width: 40px; min-height: 40px;
  border-radius: 20px; }} .dl input[type=text] {{ min-height: 42px; font-size: 16px; }} }}
</style>"""
