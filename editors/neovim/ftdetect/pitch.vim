autocmd BufRead,BufNewFile *.pitch setfiletype pitch
autocmd BufRead,BufNewFile *.rhai setfiletype rhai
