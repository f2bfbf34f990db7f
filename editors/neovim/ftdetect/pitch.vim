autocmd BufRead,BufNewFile *.pitch setfiletype pitch
